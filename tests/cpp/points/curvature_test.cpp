// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/curvature.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

Curvature curvature_of(const clouds::Cloud& cloud, double radius) {
  return estimate_curvature(cloud.points, cloud.normals, nearest_neighbors(cloud.points, 40), radius);
}

TEST(Curvature, OfASphereIsOneOverItsRadiusBothWays) {
  const auto curvature = curvature_of(clouds::sphere(4000, 2), 0.2);
  EXPECT_LT((curvature.principal.array() - 0.5).abs().maxCoeff(), 0.01);
}

TEST(Curvature, OfACylinderRunsAroundItAndVanishesAlongIt) {
  const auto cylinder = clouds::cylinder(4000, 0.5, 2);
  const auto curvature = curvature_of(cylinder, 0.12);
  EXPECT_LT((curvature.principal.col(0).array() - 2).abs().maxCoeff(), 0.05);
  EXPECT_LT(curvature.principal.col(1).array().abs().maxCoeff(), 0.05);
  EXPECT_LT(curvature.direction1.col(2).array().abs().maxCoeff(), 0.05);
}

TEST(Curvature, ChangesItsSignWithTheNormals) {
  const auto sphere = clouds::sphere(1000);
  const auto outward = curvature_of(sphere, 0.2), inward = curvature_of(clouds::flipped(sphere), 0.2);
  EXPECT_LT((outward.principal + inward.principal).array().abs().maxCoeff(), 1e-9);
}

TEST(Curvature, ScalesInverselyWithTheShape) {
  const auto small = curvature_of(clouds::sphere(1000, 1), 0.2), large = curvature_of(clouds::sphere(1000, 10), 2);
  EXPECT_LT((small.principal - 10 * large.principal).array().abs().maxCoeff(), 1e-9);
}

TEST(Curvature, OfAPlaneIsZero) {
  EXPECT_LT(curvature_of(clouds::plane(1000), 0.1).principal.array().abs().maxCoeff(), 1e-12);
}

TEST(Curvature, NeedsAPositiveRadius) { EXPECT_THROW(curvature_of(clouds::sphere(100), 0), InvalidArgument); }

}  // namespace
}  // namespace hdpea
