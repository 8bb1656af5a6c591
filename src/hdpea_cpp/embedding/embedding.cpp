// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/embedding/embedding.hpp"

#include <tbb/parallel_invoke.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/cholesky.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

using Psi = Cholesky::Columns;  // (n, 5)
using Corners = Eigen::Matrix<double, 3, 5>;
using Frame = Eigen::Matrix<double, 5, 2>;

/// What one triangle contributes: all of it constant but psi.
struct Element {
  Eigen::Matrix<double, 2, 3> gradients;  ///< of the three hat functions, in the triangle's frame
  Eigen::Matrix2d excess;                 ///< Q = sqrt(M - I)
  double area;                            ///< times the triangle's weight
};

Eigen::Matrix2d sqrt_spd(Eigen::Matrix2d matrix) {
  // Closed form for 2 x 2, by Cayley-Hamilton.
  const double root = std::sqrt(std::max(matrix.determinant(), 0.0));
  const double scale = std::sqrt(std::max(matrix.trace() + 2 * root, 0.0));
  if (scale == 0) return Eigen::Matrix2d::Zero();
  matrix.diagonal().array() += root;
  return matrix / scale;
}

/// The closest R with orthonormal columns to a 5 x 2 matrix, zero along directions the matrix does not have.
Eigen::Matrix<double, 5, 2> polar_factor(const Eigen::Matrix<double, 5, 2>& matrix) {
  Eigen::Matrix2d gram = matrix.transpose() * matrix;
  gram.diagonal().array() += 1e-12 * gram.trace() + 1e-100;
  return matrix * sqrt_spd(gram).inverse();
}

/// M - I of a point as a symmetric tensor of R^3 that is zero along the normal; the formula is that of Metric in
/// python/hdpea/geometry/metric.py.
Eigen::Matrix3d metric_excess(const PointsRef& normals, const Curvature& curvature, Index i,
                              const EmbeddingOptions& options) {
  const Eigen::Vector3d direction1 = curvature.direction1.row(i).transpose();
  const Eigen::Vector3d direction2 = normals.row(i).transpose().cross(direction1);
  const double most = options.max_stretch * options.max_stretch;
  const double excess1 = std::clamp(options.metric_scale * std::abs(curvature.principal(i, 0)), 1.0, most) - 1;
  const double excess2 = std::clamp(options.metric_scale * std::abs(curvature.principal(i, 1)), 1.0, most) - 1;
  return excess1 * direction1 * direction1.transpose() + excess2 * direction2 * direction2.transpose();
}

std::vector<Eigen::Matrix3d> metric_excess(const PointsRef& normals, const Curvature& curvature,
                                           const EmbeddingOptions& options) {
  std::vector<Eigen::Matrix3d> excess(static_cast<std::size_t>(normals.rows()));
  parallel_for(normals.rows(), [&](Index i) { excess[i] = metric_excess(normals, curvature, i, options); });
  return excess;
}

/// The triangles as finite elements: the Laplacian and the local step of the iteration.
class Elements {
 public:
  Elements(const PointsRef& points, const FacesRef& triangles, const Eigen::Ref<const Eigen::VectorXd>& weights,
           const std::vector<Eigen::Matrix3d>& excess_of_points)
      : triangles_(triangles), elements_(static_cast<std::size_t>(triangles.rows())) {
    parallel_for(triangles.rows(),
                 [&](Index t) { elements_[t] = make_element(points, t, weights(t), excess_of_points); });
    areas_ = Eigen::VectorXd::Zero(points.rows());
    for (Index t = 0; t < triangles.rows(); ++t) {
      for (Index v : triangles.row(t)) areas_(v) += elements_[t].area / 3;
    }
    index_corners();
  }

  const Eigen::VectorXd& areas() const { return areas_; }

  SparseMatrix laplacian() const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(elements_.size() * 9);
    for (Index t = 0; t < triangles_.rows(); ++t) {
      const Element& element = elements_[t];
      const Eigen::Matrix3d stiffness = element.area * element.gradients.transpose() * element.gradients;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          entries.emplace_back(static_cast<int>(triangles_(t, i)), static_cast<int>(triangles_(t, j)), stiffness(i, j));
        }
      }
    }
    SparseMatrix matrix(areas_.size(), areas_.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// The local step and the divergence of its frames: sum over triangles of area (R Q) grad(hat).
  void divergence_of_frames(const Psi& psi, Psi& divergence) {
    frames_.resize(elements_.size());
    parallel_for(triangles_.rows(), [&](Index t) {
      const Element& element = elements_[t];
      Corners corners;
      for (int i = 0; i < 3; ++i) corners.row(i) = psi.row(triangles_(t, i));
      const Eigen::Matrix<double, 5, 2> jacobian = (element.gradients * corners).transpose();
      frames_[t].noalias() = element.area * polar_factor(jacobian * element.excess) * element.excess;
    });
    // Gathered by vertex in the order of the triangles, so that threads cannot change the sums.
    parallel_for(psi.rows(), [&](Index v) {
      Eigen::Matrix<double, 1, 5> sum = Eigen::Matrix<double, 1, 5>::Zero();
      for (Index at = starts_[v]; at < starts_[v + 1]; ++at) {
        const Index t = corners_[at] / 3;
        sum += (frames_[t] * elements_[t].gradients.col(corners_[at] % 3)).transpose();
      }
      divergence.row(v) = sum;
    });
  }

 private:
  Element make_element(const PointsRef& points, Index t, double weight,
                       const std::vector<Eigen::Matrix3d>& excess_of_points) const {
    const Eigen::Vector3d a = points.row(triangles_(t, 0)).transpose();
    const Eigen::Vector3d ab = points.row(triangles_(t, 1)).transpose() - a;
    const Eigen::Vector3d ac = points.row(triangles_(t, 2)).transpose() - a;
    const double twice_area = ab.cross(ac).norm();
    // A sliver has no well-defined frame and (nearly) no area: it contributes nothing.
    if (twice_area <= 1e-10 * (ab.squaredNorm() + ac.squaredNorm())) {
      return {Eigen::Matrix<double, 2, 3>::Zero(), Eigen::Matrix2d::Zero(), 0};
    }
    Eigen::Matrix<double, 3, 2> frame;
    frame.col(0) = ab.normalized();
    frame.col(1) = (ac - ac.dot(frame.col(0)) * frame.col(0)).normalized();
    Eigen::Matrix2d edges;
    edges << frame.transpose() * ab, frame.transpose() * ac;
    Element element;
    element.gradients.rightCols<2>() = edges.inverse().transpose();
    element.gradients.col(0) = -element.gradients.rightCols<2>().rowwise().sum();
    element.area = weight * twice_area / 2;
    Eigen::Matrix3d excess = Eigen::Matrix3d::Zero();
    for (Index v : triangles_.row(t)) excess += excess_of_points[v] / 3;
    element.excess = sqrt_spd(frame.transpose() * excess * frame);
    return element;
  }

  /// Lists, for each vertex, the triangle corners that lie on it (compressed rows).
  void index_corners() {
    starts_.assign(static_cast<std::size_t>(areas_.size()) + 1, 0);
    for (Index v : triangles_.reshaped<Eigen::RowMajor>()) ++starts_[v + 1];
    for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    corners_.resize(static_cast<std::size_t>(triangles_.size()));
    std::vector<Index> next(starts_.begin(), starts_.end() - 1);
    for (Index corner = 0; corner < triangles_.size(); ++corner) {
      corners_[next[triangles_(corner / 3, corner % 3)]++] = corner;
    }
  }

  const FacesRef& triangles_;
  std::vector<Element> elements_;
  Eigen::VectorXd areas_;
  std::vector<Index> starts_, corners_;
  std::vector<Frame> frames_;  // R Q, times the area
};

/// The normal separates the two sides of a wall; a little of the last two dimensions lets psi unfold into them.
Psi initial_psi(const PointsRef& normals) {
  Psi psi(normals.rows(), 5);
  psi.leftCols<3>() = 0.2 * normals;
  for (Index i = 0; i < psi.rows(); ++i) {
    for (Index column = 3; column < 5; ++column) {
      // Weyl sequences: they serve as noise, and are the same on every machine.
      const double step = column == 3 ? 0.7548776662466927 : 0.5698402909980532;
      const double unit = std::fmod(static_cast<double>(i + 1) * step, 1.0);
      psi(i, column) = 1e-3 * (2 * unit - 1);
    }
  }
  return psi;
}

/// Holds the mean psi of every connected piece where it was at first.
///
/// The metric does not depend on a piece's translation, and the anchor holds it weakly: without this, amplified
/// rounding errors would move it, and a shifted cloud would get another mesh.
class PinnedMeans {
 public:
  PinnedMeans(const FacesRef& triangles, const Eigen::VectorXd& areas, const Psi& psi)
      : piece_(static_cast<std::size_t>(psi.rows())), areas_(areas) {
    DisjointSets sets(psi.rows());
    for (Index t = 0; t < triangles.rows(); ++t) {
      sets.join(triangles(t, 0), triangles(t, 1));
      sets.join(triangles(t, 0), triangles(t, 2));
    }
    piece_areas_ = Eigen::VectorXd::Zero(psi.rows());
    for (Index v = 0; v < psi.rows(); ++v) {
      piece_[v] = sets.find(v);
      piece_areas_(piece_[v]) += areas(v);
    }
    pinned_ = means(psi);
  }

  void restore(Psi& psi) const {
    const Psi shifts = pinned_ - means(psi);
    for (Index v = 0; v < psi.rows(); ++v) psi.row(v) += shifts.row(piece_[v]);
  }

 private:
  /// Means by area, in the row of each piece's first vertex.
  Psi means(const Psi& psi) const {
    Psi sums = Psi::Zero(psi.rows(), 5);
    for (Index v = 0; v < psi.rows(); ++v) sums.row(piece_[v]) += areas_(v) * psi.row(v);
    return piece_areas_.cwiseMax(1e-300).cwiseInverse().asDiagonal() * sums;
  }

  std::vector<Index> piece_;
  const Eigen::VectorXd& areas_;
  Eigen::VectorXd piece_areas_;  // in the row of each piece's first vertex
  Psi pinned_;
};

SparseMatrix diagonal(const Eigen::VectorXd& values) { return SparseMatrix(values.asDiagonal()); }

}  // namespace

Coordinates solve_embedding(const PointsRef& points, const PointsRef& normals, const Curvature& curvature,
                            const FacesRef& triangles, const Eigen::Ref<const Eigen::VectorXd>& weights,
                            const EmbeddingOptions& options, const Progress& progress,
                            const std::optional<Coordinates>& initial) {
  const Index n = points.rows();
  require(n >= 1, "solve_embedding needs at least one point");
  require_finite(points, "points");
  require_rows(normals, n, "normals");
  require_finite(normals, "normals");
  require_rows(curvature.principal, n, "principal curvatures");
  require_finite(curvature.principal, "principal curvatures");
  require_rows(curvature.direction1, n, "principal directions");
  require_finite(curvature.direction1, "principal directions");
  require_indices(triangles, 0, n, "triangles");
  require_rows(weights, triangles.rows(), "weights");
  require(weights.size() == 0 || (weights.allFinite() && weights.minCoeff() >= 0), "weights must be 0 or more");
  require(options.metric_scale > 0 && options.max_stretch >= 1 && options.bending_length >= 0 &&
              std::isfinite(options.bending_length) && options.iterations >= 0,
          "metric_scale must be positive, max_stretch at least 1, bending_length and iterations at least 0");
  require(!initial || (initial->rows() == n && initial->cols() == 5), "the initial psi must be (n, 5)");
  if (initial) require_finite(*initial, "the initial psi");

  Elements elements(points, triangles, weights, metric_excess(normals, curvature, options));

  // Points in no triangle get a little area of their own; a little of A makes L definite, however much the
  // slivers between nearly equal points weigh. It slows psi's convergence by its ratio to L's eigenvalues, which
  // are tens, and does not move what psi converges to.
  const double mean_area = std::max(elements.areas().mean(), 1e-300);
  const Eigen::VectorXd areas = elements.areas().cwiseMax(1e-3 * mean_area);
  const double anchor = 1e-3 / (points.colwise().maxCoeff() - points.colwise().minCoeff()).squaredNorm();
  if (!std::isfinite(anchor)) throw CannotReconstruct("the points lie in one place");
  const double squared_length = options.bending_length * options.bending_length;
  std::optional<Cholesky> bending, poisson;
  {
    const SparseMatrix anchored = elements.laplacian() + anchor * diagonal(areas);
    // Neither needs the other, and a factorization takes one thread.
    tbb::parallel_invoke([&] { bending.emplace(squared_length * anchored + diagonal(areas)); },
                         [&] { poisson.emplace(anchored); });
  }

  Psi psi = initial ? Psi(*initial) : initial_psi(normals);
  Psi ahead = psi, next(n, 5), bent(n, 5);
  const PinnedMeans pinned_means(triangles, areas, psi);
  for (Index iteration = 0; iteration < options.iterations; ++iteration) {
    report(progress, static_cast<double>(iteration) / static_cast<double>(options.iterations));
    elements.divergence_of_frames(ahead, next);
    // By partial fractions (see the header) one solve for each core.
    bent = squared_length * next;
    next += anchor * areas.asDiagonal() * ahead;
    tbb::parallel_invoke([&] { bending->solve_in_place(bent); }, [&] { poisson->solve_in_place(next); });
    next -= bent;
    pinned_means.restore(next);
    // Nesterov's momentum (1983). Local/global iteration converges slowly and steadily, with eigenvalues in [0, 1],
    // where it is stable: 25 rounds do what 60 did. The first steps, which are large, get little of it.
    const double momentum = static_cast<double>(iteration) / static_cast<double>(iteration + 3);
    ahead = next + momentum * (next - psi);
    psi.swap(next);
  }
  if (!psi.allFinite()) {
    throw CannotReconstruct(
        "the embedding does not converge: a length is out of proportion to the spacing of the points");
  }
  report(progress, 1);
  return psi;
}

}  // namespace hdpea
