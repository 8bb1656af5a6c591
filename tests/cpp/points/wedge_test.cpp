// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/wedge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace hdpea {
namespace {

/// Two half-planes that meet along the y axis at a right angle, facing +z and +x.
Neighborhood corner_of_a_box() {
  Neighborhood around{{}, {}, {0.2, 0, 0.1}, 0.5};
  for (int i = 1; i <= 4; ++i) {
    for (int j = -2; j <= 2; ++j) {
      around.points.emplace_back(-0.5 * i, 0.5 * j, 0);
      around.normals.emplace_back(0, 0, 1);
      around.points.emplace_back(0, 0.5 * j, -0.5 * i);
      around.normals.emplace_back(1, 0, 0);
    }
  }
  return around;
}

TEST(Wedge, OfTwoHalfPlanesIsTheirLine) {
  const Neighborhood around = corner_of_a_box();
  const auto normals = differing_normals(around);
  ASSERT_EQ(normals.size(), 2);
  const auto wedge = fit_wedge(around, normals[0], normals[1]);
  ASSERT_TRUE(wedge);
  EXPECT_LT(wedge->position.norm(), 1e-9);
  EXPECT_NEAR(std::abs(wedge->direction.y()), 1, 1e-9);
  EXPECT_NEAR(wedge->residual, 0, 1e-12);
  EXPECT_GT(quadric_residual(around, (normals[0] + normals[1]).normalized()), 0.01);
}

TEST(Wedge, OfARimTouchesItThoughItBends) {
  // The mouth of a hole with a radius of 5 spacings. A straight wedge would lie 0.4 inside.
  constexpr double radius = 5, turn = 0.2;
  Neighborhood around{{}, {}, {radius + 0.1, 0.2, -0.1}, 1};
  for (int j = -3; j <= 3; ++j) {
    const Eigen::Vector3d out(std::cos(turn * j), std::sin(turn * j), 0);
    for (int i = 1; i <= 3; ++i) {
      around.points.push_back((radius + i - 0.5) * out);
      around.normals.emplace_back(0, 0, 1);
      around.points.push_back(radius * out - Eigen::Vector3d(0, 0, i - 0.5));
      around.normals.push_back(-out);
    }
  }
  const auto wedge = fit_wedge(around, {0, 0, 1}, {-1, 0, 0});
  ASSERT_TRUE(wedge);
  EXPECT_TRUE(wedge->convex);
  EXPECT_NEAR(wedge->position.head<2>().norm(), radius, 0.1);
  EXPECT_NEAR(wedge->position.z(), 0, 0.1);
}

TEST(Wedge, OfOnePlaneIsNone) {
  Neighborhood around = corner_of_a_box();
  for (auto& point : around.points) point.z() = 0;
  for (auto& normal : around.normals) normal = {0, 0, 1};
  const auto normals = differing_normals(around);
  EXPECT_FALSE(fit_wedge(around, normals[0], normals[1]));
}

TEST(Wedge, NormalsThatDifferAreOneOfEachSideOfACorner) {
  Neighborhood around = corner_of_a_box();
  for (int i = 0; i < 5; ++i) {
    around.points.emplace_back(-0.2 * i, 1.1, -0.2);
    around.normals.emplace_back(0, 1, 0);
  }
  const auto normals = differing_normals(around);
  ASSERT_EQ(normals.size(), 3);
  EXPECT_NEAR(std::abs(normals[0].dot(normals[1].cross(normals[2]))), 1, 1e-9);
}

TEST(Wedge, OfFewPointsIsNone) {
  Neighborhood around = corner_of_a_box();
  around.points.resize(6);
  around.normals.resize(6);
  EXPECT_FALSE(fit_wedge(around, {0, 0, 1}, {1, 0, 0}));
}

}  // namespace
}  // namespace hdpea
