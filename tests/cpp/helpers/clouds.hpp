// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of analytic surfaces with true normals, the same on every machine.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "hdpea_cpp/base/types.hpp"

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

/// A torus of radii 1 and 0.4, even along its meridians.
inline Cloud torus(Index n) {
  Cloud cloud{Points(n, 3), Points(n, 3)};
  for (Index i = 0; i < n; ++i) {
    const double u = 2 * std::numbers::pi * weyl(i).x(), v = 2 * std::numbers::pi * weyl(i).y();
    cloud.normals.row(i) << std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v);
    cloud.points.row(i) << std::cos(u), std::sin(u), 0;
  }
  cloud.points += 0.4 * cloud.normals;
  return cloud;
}

inline Cloud flipped(Cloud cloud) {
  cloud.normals *= -1;
  return cloud;
}

/// The six faces of the unit cube, each sampled like a plane, with outward normals.
inline Cloud cube(Index per_face) {
  Cloud cube{Points(0, 3), Points(0, 3)};
  for (int axis = 0; axis < 3; ++axis) {
    for (double side : {0.0, 1.0}) {
      const Cloud square = plane(per_face, side);
      Cloud face{Points(per_face, 3), Points::Zero(per_face, 3)};
      for (int column = 0; column < 3; ++column) face.points.col((axis + 1 + column) % 3) = square.points.col(column);
      face.normals.col(axis).setConstant(2 * side - 1);
      cube = joined(cube, face);
    }
  }
  return cube;
}

/// A unit square of so many points on either side, three of their spacings thick, with a rim.
inline Cloud thin_plate(Index per_side = 2500) {
  Cloud plate = cube(per_side);
  plate.points.col(2) *= 3 / std::sqrt(static_cast<double>(per_side));
  return plate;
}

}  // namespace hdpea::clouds
