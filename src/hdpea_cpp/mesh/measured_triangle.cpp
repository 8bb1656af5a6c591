// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/measured_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hdpea {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

MeasuredTriangle::MeasuredTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
    : a_(a), b_(b), c_(c), ab_(b - a), bc_(c - b), ca_(a - c) {
  for (int i = 0; i < 3; ++i) {
    const double length = along(i).squaredNorm();
    inverse_[i] = length > 0 ? 1 / length : 0;
  }
  const Eigen::Vector3d normal = ca_.cross(ab_);
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return;
  normal_ = normal / std::sqrt(squared);
  to_b_ = normal.cross(ca_) / squared;
  to_c_ = normal.cross(ab_) / squared;
}

double MeasuredTriangle::squared_distance(const Eigen::Vector3d& point, double bound) const {
  const Eigen::Vector3d d = point - a_;
  const double height = d.dot(normal_);
  if (height * height >= bound) return kInfinity;
  const Eigen::Vector3d inside = coordinates(d);
  if (inside.minCoeff() > 0) return height * height;
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (!may_be_nearest(i, inside)) continue;
    least = std::min(least, (point - from(i) - share_along(i, point) * along(i)).squaredNorm());
  }
  return least;
}

Eigen::Vector3d MeasuredTriangle::weights(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d inside = coordinates(point - a_);
  if (inside.minCoeff() > 0) return inside;
  Eigen::Vector3d nearest = Eigen::Vector3d::UnitX();
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (!may_be_nearest(i, inside)) continue;
    const double t = share_along(i, point);
    const double squared = (point - from(i) - t * along(i)).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest.setZero();
    nearest[i] = 1 - t;
    nearest[(i + 1) % 3] = t;
  }
  return nearest;
}

Eigen::Vector3d MeasuredTriangle::coordinates(const Eigen::Vector3d& from_a) const {
  const double b = from_a.dot(to_b_), c = from_a.dot(to_c_);
  return {1 - b - c, b, c};
}

bool MeasuredTriangle::may_be_nearest(int i, const Eigen::Vector3d& inside) const {
  return inside[(i + 2) % 3] <= 0 || normal_.isZero(0);
}

double MeasuredTriangle::share_along(int i, const Eigen::Vector3d& point) const {
  return std::clamp((point - from(i)).dot(along(i)) * inverse_[i], 0.0, 1.0);
}

}  // namespace hdpea
