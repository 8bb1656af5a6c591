// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/measured_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hdpea {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The share of a segment at which it is nearest to a point.
double share_along(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  const double length = along.squaredNorm();
  return length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0;
}

}  // namespace

MeasuredTriangle::MeasuredTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
    : a_(a), b_(b), c_(c), ab_(b - a), bc_(c - b), ca_(a - c) {
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
  const double b = d.dot(to_b_), c = d.dot(to_c_);
  if (b > 0 && c > 0 && b + c < 1) return height * height;
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const double t = share_along(point, from(i), along(i));
    least = std::min(least, (point - from(i) - t * along(i)).squaredNorm());
  }
  return least;
}

Eigen::Vector3d MeasuredTriangle::weights(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d d = point - a_;
  const double b = d.dot(to_b_), c = d.dot(to_c_);
  if (b > 0 && c > 0 && b + c < 1) return {1 - b - c, b, c};
  Eigen::Vector3d nearest = Eigen::Vector3d::UnitX();
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const double t = share_along(point, from(i), along(i));
    const double squared = (point - from(i) - t * along(i)).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest.setZero();
    nearest[i] = 1 - t;
    nearest[(i + 1) % 3] = t;
  }
  return nearest;
}

}  // namespace hdpea
