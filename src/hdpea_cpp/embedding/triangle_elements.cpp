// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/embedding/triangle_elements.hpp"

#include <algorithm>
#include <cmath>

#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

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

TriangleElement make_element(const PointsRef& points, const Eigen::Ref<const Eigen::RowVector3<Index>>& corners,
                             double weight, const std::vector<Eigen::Matrix3d>& excess_of_points) {
  const Eigen::Vector3d a = points.row(corners(0)).transpose();
  const Eigen::Vector3d ab = points.row(corners(1)).transpose() - a;
  const Eigen::Vector3d ac = points.row(corners(2)).transpose() - a;
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
  TriangleElement element;
  element.gradients.rightCols<2>() = edges.inverse().transpose();
  element.gradients.col(0) = -element.gradients.rightCols<2>().rowwise().sum();
  element.area = weight * twice_area / 2;
  Eigen::Matrix3d excess = Eigen::Matrix3d::Zero();
  for (Index v : corners) excess += excess_of_points[v] / 3;
  element.excess = sqrt_spd(frame.transpose() * excess * frame);
  return element;
}

}  // namespace

TriangleElements::TriangleElements(const PointsRef& points, const FacesRef& triangles,
                                   const Eigen::Ref<const Eigen::VectorXd>& weights,
                                   const std::vector<Eigen::Matrix3d>& excess_of_points)
    : triangles_(triangles), elements_(static_cast<std::size_t>(triangles.rows())) {
  parallel_for(triangles.rows(),
               [&](Index t) { elements_[t] = make_element(points, triangles.row(t), weights(t), excess_of_points); });
  areas_ = Eigen::VectorXd::Zero(points.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (Index v : triangles.row(t)) areas_(v) += elements_[t].area / 3;
  }
  index_corners();
}

SparseMatrix TriangleElements::laplacian() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(elements_.size() * 9);
  for (Index t = 0; t < triangles_.rows(); ++t) {
    const TriangleElement& element = elements_[t];
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

void TriangleElements::divergence_of_frames(const Psi& psi, Psi& divergence) {
  frames_.resize(elements_.size());
  parallel_for(triangles_.rows(), [&](Index t) {
    const TriangleElement& element = elements_[t];
    Eigen::Matrix<double, 3, 5> corners;
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

void TriangleElements::index_corners() {
  starts_.assign(static_cast<std::size_t>(areas_.size()) + 1, 0);
  for (Index v : triangles_.reshaped<Eigen::RowMajor>()) ++starts_[v + 1];
  for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
  corners_.resize(static_cast<std::size_t>(triangles_.size()));
  std::vector<Index> next(starts_.begin(), starts_.end() - 1);
  for (Index corner = 0; corner < triangles_.size(); ++corner) {
    corners_[next[triangles_(corner / 3, corner % 3)]++] = corner;
  }
}

}  // namespace hdpea
