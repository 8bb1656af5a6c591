// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of analytic surfaces with true normals, the same on every machine.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "hdpea_cpp/types.hpp"

namespace hdpea::clouds {

struct Cloud {
  Points points, normals;
};

/// The i-th point of a two-dimensional Weyl sequence: even, and never twice the same.
inline Eigen::Vector2d weyl(Index i) {
  return {std::fmod(0.5 + double(i) * 0.7548776662466927, 1.0), std::fmod(0.5 + double(i) * 0.5698402909980532, 1.0)};
}

inline Cloud sphere(Index n, double radius = 1) {
  Cloud cloud{Points(n, 3), Points(n, 3)};
  for (Index i = 0; i < n; ++i) {
    const double z = 1 - (2 * double(i) + 1) / double(n), angle = double(i) * 2.399963229728653;
    const double r = std::sqrt(1 - z * z);
    cloud.normals.row(i) << r * std::cos(angle), r * std::sin(angle), z;
  }
  cloud.points = radius * cloud.normals;
  return cloud;
}

/// An open cylinder about the z axis, evenly sampled.
inline Cloud cylinder(Index n, double radius, double height) {
  Cloud cloud{Points(n, 3), Points(n, 3)};
  for (Index i = 0; i < n; ++i) {
    const Eigen::Vector2d u = weyl(i);
    const double angle = 2 * std::numbers::pi * u.x();
    cloud.normals.row(i) << std::cos(angle), std::sin(angle), 0;
    cloud.points.row(i) << radius * std::cos(angle), radius * std::sin(angle), height * (u.y() - 0.5);
  }
  return cloud;
}

/// The unit square facing up, at height z.
inline Cloud plane(Index n, double z = 0) {
  Cloud cloud{Points(n, 3), Points(n, 3)};
  for (Index i = 0; i < n; ++i) {
    cloud.points.row(i) << weyl(i).transpose(), z;
    cloud.normals.row(i) << 0, 0, 1;
  }
  return cloud;
}

inline Cloud joined(const Cloud& a, const Cloud& b) {
  Cloud cloud{Points(a.points.rows() + b.points.rows(), 3), Points(a.points.rows() + b.points.rows(), 3)};
  cloud.points << a.points, b.points;
  cloud.normals << a.normals, b.normals;
  return cloud;
}

inline Cloud flipped(Cloud cloud) {
  cloud.normals *= -1;
  return cloud;
}

}  // namespace hdpea::clouds
