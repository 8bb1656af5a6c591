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
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/embedding/pinned_means.hpp"
#include "hdpea_cpp/embedding/triangle_elements.hpp"

namespace hdpea {
namespace {

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

SparseMatrix diagonal(const Eigen::VectorXd& values) { return SparseMatrix(values.asDiagonal()); }

void require_contract(const PointsRef& points, const PointsRef& normals, const Curvature& curvature,
                      const FacesRef& triangles, const Eigen::Ref<const Eigen::VectorXd>& weights,
                      const EmbeddingOptions& options, const std::optional<Coordinates>& initial) {
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
}

}  // namespace

Coordinates solve_embedding(const PointsRef& points, const PointsRef& normals, const Curvature& curvature,
                            const FacesRef& triangles, const Eigen::Ref<const Eigen::VectorXd>& weights,
                            const EmbeddingOptions& options, const Progress& progress,
                            const std::optional<Coordinates>& initial) {
  require_contract(points, normals, curvature, triangles, weights, options, initial);
  TriangleElements elements(points, triangles, weights, metric_excess(normals, curvature, options));

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
  Psi ahead = psi, next = psi, bent = psi;
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
