// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/seams.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

/// Two strips, the second of which begins before the first ends, and two spacings above it.
clouds::Cloud overlapping_strips() {
  auto strips = clouds::joined(clouds::plane(2500), clouds::plane(2500, 2 / 50.0));
  strips.points.bottomRows(2500).col(0).array() += 0.8;
  return strips;
}

TEST(Seams, OfStripsThatOverlapAreNoWalls) {
  const auto strips = overlapping_strips();
  const Neighbors neighbors = nearest_neighbors(strips.points, 16);
  Points like_a_wall = strips.normals;
  for (Index i = 0; i < 2500; ++i) {
    if (strips.points(i, 0) > 0.8) like_a_wall.row(i) *= -1;
  }
  EXPECT_EQ(turn_at_seams(strips.points, like_a_wall, neighbors), strips.normals);
  EXPECT_EQ(turn_at_seams(strips.points, -like_a_wall, neighbors), -strips.normals);
}

class WithoutSeams : public testing::TestWithParam<clouds::Cloud> {};

TEST_P(WithoutSeams, NothingIsTurned) {
  const auto& [points, normals] = GetParam();
  EXPECT_EQ(turn_at_seams(points, normals, nearest_neighbors(points, 16)), normals);
}

/// A plate whose faces are nearer to each other than their points are: these lie in each other's planes.
clouds::Cloud thinnest_plate() {
  auto plate = clouds::joined(clouds::plane(2500, 0.1 / 50), clouds::flipped(clouds::plane(2500)));
  plate.points.bottomRows(2500).leftCols(2).array() += 0.4 / 50;
  return plate;
}

INSTANTIATE_TEST_SUITE_P(Shapes, WithoutSeams,
                         testing::Values(overlapping_strips(), clouds::cube(900), clouds::thin_plate(),
                                         thinnest_plate(), clouds::torus(3000)));

}  // namespace
}  // namespace hdpea
