// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hdpea_cpp/base/cholesky.hpp"
#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

using Psi = Cholesky::Columns;  ///< (n, 5)

/// What one triangle contributes: all of it constant but psi.
struct TriangleElement {
  Eigen::Matrix<double, 2, 3> gradients;  ///< of the three hat functions, in the triangle's frame
  Eigen::Matrix2d excess;                 ///< Q = sqrt(M - I)
  double area;                            ///< times the triangle's weight
};

/// The triangles as finite elements: the Laplacian and the local step of the iteration.
class TriangleElements {
 public:
  /// @param excess_of_points  M - I of each point as a tensor of R^3
  TriangleElements(const PointsRef& points, const FacesRef& triangles, const Eigen::Ref<const Eigen::VectorXd>& weights,
                   const std::vector<Eigen::Matrix3d>& excess_of_points);

  /// A third of the triangles' areas, times their weights, at each vertex.
  const Eigen::VectorXd& areas() const { return areas_; }

  SparseMatrix laplacian() const;

  /// The local step and the divergence of its frames: sum over triangles of area (R Q) grad(hat).
  void divergence_of_frames(const Psi& psi, Psi& divergence);

 private:
  using Frame = Eigen::Matrix<double, 5, 2>;

  /// Lists, for each vertex, the triangle corners that lie on it (compressed rows).
  void index_corners();

  const FacesRef& triangles_;
  std::vector<TriangleElement> elements_;
  Eigen::VectorXd areas_;
  std::vector<Index> starts_, corners_;
  std::vector<Frame> frames_;  // R Q, times the area
};

}  // namespace hdpea
