// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/tangent_basis.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

constexpr double kWeightWidth = 0.7;  // of the Gaussian weights, in root mean squared distances of the neighbours

using Plane = Eigen::Matrix<double, 3, 2>;

Plane plane_across(const Eigen::Vector3d& normal) {
  Plane plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.cross(plane.col(0));
  return plane;
}

double squared_reach(const CoordinatesRef& coordinates, const NeighborsRef& neighbors, Index i) {
  double sum = 0;
  Index count = 0;
  for (Index j : neighbors.row(i)) {
    if (j < 0) continue;
    sum += (coordinates.row(j) - coordinates.row(i)).head<3>().squaredNorm();
    ++count;
  }
  return sum / static_cast<double>(std::max<Index>(count, 1));
}

/// The linear part (2, d - 3) of the affine map that takes the plane to the extra coordinates.
Eigen::MatrixXd fit_extra(const CoordinatesRef& coordinates, const NeighborsRef& neighbors, Index i,
                          const Plane& plane) {
  const Index extra = coordinates.cols() - 3;
  const double squared_width = std::max(kWeightWidth * kWeightWidth * squared_reach(coordinates, neighbors, i), 1e-300);
  Eigen::Matrix3d system = Eigen::Vector3d::UnitX() * Eigen::RowVector3d::UnitX();  // the point itself
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(3, extra);
  for (Index j : neighbors.row(i)) {
    if (j < 0) continue;
    const Eigen::RowVectorXd offset = coordinates.row(j) - coordinates.row(i);
    const double weight = std::exp(-offset.head<3>().squaredNorm() / squared_width);
    const Eigen::Vector2d in_plane = plane.transpose() * offset.head<3>().transpose();
    const Eigen::Vector3d terms(1, in_plane.x(), in_plane.y());
    system += weight * terms * terms.transpose();
    right += weight * terms * offset.tail(extra);
  }
  // A trace of damping: along a direction without neighbours psi does not change.
  system.diagonal().tail<2>().array() += 1e-9 * system.diagonal().tail<2>().sum() + 1e-300;
  return system.ldlt().solve(right).bottomRows(2);
}

}  // namespace

Coordinates tangent_bases(const CoordinatesRef& coordinates, const PointsRef& normals, const NeighborsRef& neighbors) {
  const Index n = coordinates.rows(), d = coordinates.cols();
  require_neighborhoods(coordinates, normals, neighbors);
  require_directions(normals, "normals");
  require(d >= 3, "the first three coordinates are positions");
  Coordinates bases(n, 2 * d);
  parallel_for(n, [&](Index i) {
    const Plane plane = plane_across(normals.row(i).transpose());
    Eigen::MatrixXd tangents(2, d);
    tangents.leftCols<3>() = plane.transpose();
    if (d > 3) tangents.rightCols(d - 3) = fit_extra(coordinates, neighbors, i, plane);
    tangents.row(0).normalize();
    tangents.row(1) -= tangents.row(1).dot(tangents.row(0)) * tangents.row(0);
    tangents.row(1).normalize();
    bases.row(i) << tangents.row(0), tangents.row(1);
  });
  return bases;
}

Coordinates tangent_bases_across(const PointsRef& normals) {
  require_directions(normals, "normals");
  Coordinates bases(normals.rows(), 6);
  for (Index i = 0; i < normals.rows(); ++i) {
    const Plane plane = plane_across(normals.row(i).transpose());
    bases.row(i) << plane.col(0).transpose(), plane.col(1).transpose();
  }
  return bases;
}

}  // namespace hdpea
