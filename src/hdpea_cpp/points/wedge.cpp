// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/wedge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hdpea_cpp/points/bent_wedge.hpp"
#include "hdpea_cpp/points/planes.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::Vector3d;

/// Unknowns of two planes, and of a quadratic height field.
constexpr double kUnknowns = 6;

/// A bent wedge is taken if its variance is less than this share of that of the straight one.
constexpr double kMuchBetter = 0.7;

/// The plane of the points of one side, by least squares. Normals count a little: points on a line leave it open.
std::optional<Plane> fit_plane(const Neighborhood& around, const std::vector<char>& sides, char side) {
  constexpr double normal_weight = 0.05;
  constexpr int least_points = 5;
  Vector sum = Vector::Zero(), normal_sum = Vector::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] != side) continue;
    const Vector x = (around.points[i] - around.centre) / around.spacing;
    const Vector& n = around.normals[i];
    sum += x;
    normal_sum += n;
    squares += x * x.transpose() - normal_weight * n * n.transpose();
    ++count;
  }
  if (count < least_points) return std::nullopt;
  const Vector mean = sum / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares - count * mean * mean.transpose());
  const Vector normal = solver.eigenvectors().col(0);
  return Plane{around.centre + around.spacing * mean, normal.dot(normal_sum) < 0 ? Vector(-normal) : normal};
}

}  // namespace

std::vector<Vector> differing_normals(const Neighborhood& around) {
  constexpr double alike = 0.8;
  constexpr std::size_t most = 4;
  Vector sum = Vector::Zero();
  for (const Vector& n : around.normals) sum += n;
  // Of each normal, how like it is to the likest of those that were taken.
  std::vector<double> likeness;
  for (const Vector& n : around.normals) likeness.push_back(n.dot(sum) / static_cast<double>(around.normals.size()));
  std::vector<Vector> taken;
  while (taken.size() < most) {
    const auto least = std::min_element(likeness.begin(), likeness.end());
    if (taken.size() >= 2 && *least > alike) break;
    const Vector next = around.normals[least - likeness.begin()];
    for (std::size_t i = 0; i < likeness.size(); ++i) {
      const double like = around.normals[i].dot(next);
      likeness[i] = taken.empty() ? like : std::max(likeness[i], like);
    }
    taken.push_back(next);
  }
  return taken;
}

std::optional<Wedge> fit_wedge(const Neighborhood& around, const Vector& first, const Vector& second) {
  constexpr int rounds = 10;
  const std::size_t count = around.points.size();
  std::vector<char> sides(count);
  for (std::size_t i = 0; i < count; ++i) sides[i] = around.normals[i].dot(first - second) > 0;
  std::optional<Plane> one, other;
  Wedge wedge;
  for (int round = 0; round < rounds; ++round) {
    one = fit_plane(around, sides, true);
    other = fit_plane(around, sides, false);
    if (!one || !other) return std::nullopt;
    const auto line = intersection(*one, *other, around.centre);
    if (!line) return std::nullopt;
    // The plane that halves the angle divides the points; which side is whose, the points of each tell.
    Vector across = one->normal - other->normal;
    const bool convex = across.dot(one->centre - other->centre) >= 0;
    if (!convex) across = -across;
    wedge = {line->first, line->second, one->normal, other->normal, convex, 0, false};
    const std::vector<char> before = sides;
    for (std::size_t i = 0; i < count; ++i) sides[i] = across.dot(around.points[i] - wedge.position) > 0;
    if (sides == before) break;
  }
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Plane& plane = sides[i] ? *one : *other;
    const double height = plane.normal.dot(around.points[i] - plane.centre) / around.spacing;
    squares += height * height;
  }
  wedge.residual = variance(squares, count, kUnknowns);
  const auto bent = fit_bent_wedge(around, sides, wedge);
  return bent && bent->residual < kMuchBetter * wedge.residual ? bent : wedge;
}

double quadric_residual(const Neighborhood& around, const Vector& axis) {
  const Index count = static_cast<Index>(around.points.size());
  const Vector u = axis.unitOrthogonal(), v = axis.cross(u);
  Eigen::Matrix<double, Eigen::Dynamic, 6> design(count, 6);
  Eigen::VectorXd heights(count);
  for (Index i = 0; i < count; ++i) {
    const Vector x = (around.points[i] - around.centre) / around.spacing;
    const double a = u.dot(x), b = v.dot(x);
    design.row(i) << 1, a, b, a * a, a * b, b * b;
    heights(i) = axis.dot(x);
  }
  const Eigen::Matrix<double, 6, 1> fit = design.householderQr().solve(heights);
  double squares = 0;
  for (Index i = 0; i < count; ++i) {
    const double a = design(i, 1), b = design(i, 2), height = heights(i) - design.row(i).dot(fit);
    const double slope_a = fit(1) + 2 * fit(3) * a + fit(4) * b, slope_b = fit(2) + fit(4) * a + 2 * fit(5) * b;
    // Across the surface, which is less than along the axis where it is steep.
    squares += height * height / (1 + slope_a * slope_a + slope_b * slope_b);
  }
  return variance(squares, around.points.size(), kUnknowns);
}

}  // namespace hdpea
