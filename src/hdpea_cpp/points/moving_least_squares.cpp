// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/moving_least_squares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

/// Share of the trace added to the diagonal, so that neighbours on a line still have a solution.
constexpr double ridge = 1e-9;

/// Share of the neighbours' range of heights by which the surface may pass above or below all of them: where it is
/// convex, its point is the highest. On smooth and on noisy clouds it passes by less than a tenth.
constexpr double overshoot = 0.25;

using Quadric = Eigen::Matrix<double, 6, 1>;

}  // namespace

SurfacePlaces moving_least_squares(const PointsRef& places, const PointsRef& normals, const PointsRef& points,
                                   const NeighborsRef& neighbors, const MovingLeastSquaresOptions& options) {
  const Index n = points.rows();
  require_rows(places, n, "places");
  require_finite(places, "places");
  require_neighborhoods(points, normals, neighbors);
  require_directions(normals, "normals");
  SurfacePlaces moved{places, normals};
  parallel_for(n, [&](Index i) {
    const Eigen::Vector3d place = places.row(i), normal = normals.row(i);
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    double radius = (points.row(i).transpose() - place).norm();
    for (Index j : neighbors.row(i)) {
      if (j >= 0) radius = std::max(radius, (points.row(j).transpose() - place).norm());
    }
    if (radius == 0) return;  // alone
    Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
    Quadric right = Quadric::Zero();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    const auto add = [&](Index j) {
      const Eigen::Vector3d offset = (points.row(j).transpose() - place) / radius;
      const double x = offset.dot(u), y = offset.dot(v);
      const double weight =
          std::exp(-(x * x + y * y) / (options.reach * options.reach) -
                   (normals.row(j).transpose() - normal).squaredNorm() / (options.agreement * options.agreement));
      Quadric terms;
      terms << 1, x, y, x * x, x * y, y * y;
      matrix.noalias() += weight * terms * terms.transpose();
      const double height = offset.dot(normal);
      right += weight * height * terms;
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    };
    add(i);
    for (Index j : neighbors.row(i)) {
      if (j >= 0) add(j);
    }
    matrix.diagonal().array() += ridge * matrix.trace();
    const Quadric quadric = matrix.ldlt().solve(right);
    if (!quadric.allFinite()) return;
    // A quadric that the neighbours do not determine may pass anywhere.
    const double margin = overshoot * (highest - lowest);
    moved.points.row(i) += radius * std::clamp(quadric[0], lowest - margin, highest + margin) * normal.transpose();
    moved.normals.row(i) = (normal - quadric[1] * u - quadric[2] * v).normalized().transpose();
  });
  return moved;
}

}  // namespace hdpea
