// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/measured_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sharp, blunt, without area, without extent.
Points corners_of(int kind) {
  Points corners(3, 3);
  switch (kind) {
    case 0:
      corners << 0, 0, 0, 1, 0, 0.2, 0.3, 0.9, 0;
      break;
    case 1:
      corners << 0, 0, 0, 3, 0, 0, 1.4, 0.1, 0;
      break;
    case 2:
      corners << 0, 0, 0, 1, 0, 0, 2, 0, 0;
      break;
    default:
      corners << 1, 1, 1, 1, 1, 1, 1, 1, 1;
  }
  return corners;
}

TEST(MeasuredTriangle, IsAsFarAsTheClosestPointOfTheSurface) {
  Points queries(1000, 3);
  for (Index i = 0; i < queries.rows(); ++i) {
    for (int k = 0; k < 3; ++k) queries(i, k) = 6 * std::fmod(0.5 + (i + 1) * (0.6180339887 + 0.13 * k), 1.0) - 2;
  }
  Faces face(1, 3);
  face << 0, 1, 2;
  for (int kind = 0; kind < 4; ++kind) {
    const Points corners = corners_of(kind);
    const MeasuredTriangle triangle(corners.row(0), corners.row(1), corners.row(2));
    const SurfacePoints closest = closest_surface_points(corners, face, queries);
    for (Index i = 0; i < queries.rows(); ++i) {
      const Eigen::Vector3d query = queries.row(i), weights = triangle.weights(query);
      EXPECT_NEAR(std::sqrt(triangle.squared_distance(query, kInfinity)), closest.distance(i), 1e-12) << kind;
      EXPECT_NEAR((corners.transpose() * weights - query).norm(), closest.distance(i), 1e-12) << kind;
      EXPECT_NEAR(weights.sum(), 1, 1e-12);
    }
  }
}

}  // namespace
}  // namespace hdpea
