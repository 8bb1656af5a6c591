// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/bent_wedge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hdpea_cpp/points/planes.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::Vector3d;

struct BentSide {
  Plane plane;     ///< touches it on the line
  double bend;     ///< curvature along the line, times the spacing
  double squares;  ///< of the distances of its points, in squared spacings
};

/// The heights of the points of one side over its plane, by least squares: linear, but for the square along the line.
std::optional<BentSide> fit_side(const Neighborhood& around, const std::vector<char>& sides, char side,
                                 const Wedge& wedge) {
  constexpr int least_points = 6;
  constexpr double flat = 0.05;  // points on a line leave its plane open
  const Vector normal = side ? wedge.first : wedge.second, along = wedge.direction, across = normal.cross(along);
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] != side) continue;
    const Vector x = (around.points[i] - wedge.position) / around.spacing;
    const double s = along.dot(x), height = normal.dot(x);
    const Eigen::Vector4d row(1, s, across.dot(x), s * s / 2);
    matrix += row * row.transpose();
    right += height * row;
    squares += height * height;
    ++count;
  }
  if (count < least_points) return std::nullopt;
  matrix.diagonal().tail<3>().array() += flat;
  const Eigen::Vector4d fit = matrix.ldlt().solve(right);
  squares += fit.dot(matrix * fit) - 2 * fit.dot(right) - flat * fit.tail<3>().squaredNorm();
  const Vector touching = (normal - fit(1) * along - fit(2) * across).normalized();
  return BentSide{{wedge.position + around.spacing * fit(0) * normal, touching}, fit(3), std::max(squares, 0.0)};
}

}  // namespace

std::optional<Wedge> fit_bent_wedge(const Neighborhood& around, const std::vector<char>& sides, Wedge wedge) {
  constexpr int rounds = 2;
  constexpr double most_bent = 0.25, unknowns = 8;
  double squares = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto one = fit_side(around, sides, true, wedge), other = fit_side(around, sides, false, wedge);
    if (!one || !other || std::max(std::abs(one->bend), std::abs(other->bend)) > most_bent) return std::nullopt;
    const auto line = intersection(one->plane, other->plane, wedge.position);
    if (!line) return std::nullopt;
    wedge = {line->first, line->second, one->plane.normal, other->plane.normal, wedge.convex, 0, true};
    squares = one->squares + other->squares;
  }
  wedge.residual = variance(squares, sides.size(), unknowns);
  return wedge;
}

}  // namespace hdpea
