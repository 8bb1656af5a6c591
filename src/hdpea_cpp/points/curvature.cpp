// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/curvature.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

constexpr Index kLeastNeighbors = 6;  // three unknowns, twice determined

/// The radius asked for, or the distance of the 6th neighbour where the cloud is sparser than that.
double local_radius(const PointsRef& points, const NeighborsRef& neighbors, Index i, double radius) {
  double sixth = 0;
  Index seen = 0;
  for (Index j : neighbors.row(i)) {
    if (j < 0) continue;
    sixth = (points.row(j) - points.row(i)).norm();
    if (++seen == kLeastNeighbors) break;
  }
  return std::max(radius, sixth);
}

/// The symmetric W = [a b; b c] of dn = W dx in the basis (u, v), as (a, b, c).
Eigen::Vector3d fit_shape_operator(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                                   Index i, double radius, const Eigen::RowVector3d& u, const Eigen::RowVector3d& v) {
  Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Index j : neighbors.row(i)) {
    if (j < 0) continue;
    const Eigen::RowVector3d offset = points.row(j) - points.row(i);
    if (offset.norm() > radius) break;
    const Eigen::RowVector3d turn = normals.row(j) - normals.row(i);
    const double weight = std::exp(-2 * offset.squaredNorm() / (radius * radius));
    const double x = offset.dot(u) / radius, y = offset.dot(v) / radius;
    const double p = turn.dot(u), q = turn.dot(v);
    const Eigen::Vector3d from_x(x, y, 0), from_y(0, x, y);
    system += weight * (from_x * from_x.transpose() + from_y * from_y.transpose());
    right += weight * (p * from_x + q * from_y);
  }
  // A trace of damping keeps collinear neighbourhoods solvable: they bend along their line only.
  system.diagonal().array() += 1e-6 * (system.trace() + 1e-300);
  return system.ldlt().solve(right) / radius;
}

}  // namespace

Curvature estimate_curvature(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                             double radius) {
  const Index n = points.rows();
  require_neighborhoods(points, normals, neighbors);
  require_directions(normals, "normals");
  require(radius > 0 && std::isfinite(radius), "the curvature radius must be positive and finite");
  Curvature curvature{{n, 2}, Points(n, 3)};
  parallel_for(n, [&](Index i) {
    const Eigen::Vector3d normal = normals.row(i).transpose();
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    const Eigen::Vector3d w = fit_shape_operator(
        points, normals, neighbors, i, local_radius(points, neighbors, i, radius), u.transpose(), v.transpose());
    Eigen::Matrix2d shape_operator;
    shape_operator << w(0), w(1), w(1), w(2);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
    solver.computeDirect(shape_operator);
    const int first = std::abs(solver.eigenvalues()(0)) > std::abs(solver.eigenvalues()(1)) ? 0 : 1;
    const Eigen::Vector2d direction = solver.eigenvectors().col(first);
    curvature.principal.row(i) << solver.eigenvalues()(first), solver.eigenvalues()(1 - first);
    curvature.direction1.row(i) = (direction(0) * u + direction(1) * v).normalized().transpose();
  });
  return curvature;
}

}  // namespace hdpea
