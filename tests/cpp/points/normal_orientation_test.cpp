// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normal_orientation.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

Points with_random_signs(Points normals) {
  for (Index i = 0; i < normals.rows(); ++i) {
    if (clouds::weyl(i * i).x() < 0.5) normals.row(i) *= -1;
  }
  return normals;
}

/// Share of the points whose normal faces the way the true one does.
double share_right(const Points& normals, const Points& truth) {
  return ((normals.array() * truth.array()).rowwise().sum() > 0).cast<double>().mean();
}

class Orientation : public testing::TestWithParam<clouds::Cloud> {};

TEST_P(Orientation, IsFoundWhateverTheSigns) {
  const auto& [points, normals] = GetParam();
  const Neighbors neighbors = nearest_neighbors(points, 16);
  const Points oriented = orient_normals(points, with_random_signs(normals), neighbors);
  EXPECT_EQ(share_right(oriented, normals), 1);
  EXPECT_EQ(oriented, orient_normals(points, normals, neighbors));
}

TEST_P(Orientation, IsSeenToBeConsistentOrNot) {
  const auto& [points, normals] = GetParam();
  const Neighbors neighbors = nearest_neighbors(points, 16);
  EXPECT_GT(orientation_consistency(points, normals, neighbors), 0.99);
  EXPECT_NEAR(orientation_consistency(points, with_random_signs(normals), neighbors), 0.5, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Orientation,
                         testing::Values(clouds::sphere(2000), clouds::cube(900), clouds::thin_plate()));

TEST(NormalOrientation, OfAPieceIsThatOfItsMajority) {
  const auto sheets = clouds::joined(clouds::plane(2000), clouds::flipped(clouds::plane(2000, 1)));
  const Neighbors neighbors = nearest_neighbors(sheets.points, 16);
  Points disturbed = sheets.normals;
  for (Index i = 0; i < disturbed.rows(); ++i) {
    if (sheets.points(i, 0) < 0.3) disturbed.row(i) *= -1;
  }
  EXPECT_EQ(agree_on_signs(sheets.points, disturbed, neighbors), sheets.normals);
  EXPECT_EQ(agree_on_signs(sheets.points, -disturbed, neighbors), -sheets.normals);
}

TEST(NormalOrientation, IsAsGivenIfThatCountsForMoreThanNeighbors) {
  const auto sphere = clouds::sphere(500);
  const Neighbors neighbors = nearest_neighbors(sphere.points, 16);
  Points disturbed = sphere.normals;
  // All of a cap: no part that is joined before votes are counted has points of both kinds.
  disturbed.topRows(200) *= -1;
  EXPECT_GT(share_right(agree_on_signs(sphere.points, disturbed, neighbors, 100), disturbed), 0.9);
  EXPECT_EQ(agree_on_signs(sphere.points, disturbed, neighbors, 0.01), sphere.normals);
  EXPECT_THROW(agree_on_signs(sphere.points, disturbed, neighbors, 0), InvalidArgument);
}

TEST(NormalOrientation, GoesNotFromAFloorToABallThatLiesOnIt) {
  const auto floor = clouds::plane(4000, -0.2);
  auto scene = clouds::joined(floor, clouds::sphere(2000, 0.2));
  scene.points.bottomRows(2000).leftCols(2).array() += 0.5;
  const Neighbors neighbors = nearest_neighbors(scene.points, 16);
  // Next to the contact both are one sheet.
  EXPECT_GT(share_right(agree_on_signs(scene.points, scene.normals, neighbors), scene.normals), 0.98);
  EXPECT_GT(share_right(orient_normals(scene.points, scene.normals, neighbors), scene.normals), 0.98);
  Mask known = Mask::Zero(6000);
  known.head(4000).setOnes();
  for (Index i = 4000; i < 6000; ++i) known(i) = scene.points(i, 2) > 0.05;
  const Points oriented = orient_normals(scene.points, scene.normals, neighbors, known);
  EXPECT_GT(share_right(oriented, scene.normals), 0.98);
}

TEST(NormalOrientation, OfTheWholeIsNotDecidedByStrays) {
  const auto sphere = clouds::sphere(2000);
  const Index strays = 26;
  Points points(2000 + strays, 3), normals(2000 + strays, 3);
  points.topRows(2000) = sphere.points;
  normals.topRows(2000) = sphere.normals;
  for (Index i = 0; i < strays; ++i) {
    points.row(2000 + i) = 1.5 * sphere.points.row(70 * i);
    normals.row(2000 + i) = sphere.normals.row((70 * i + 990) % 2000);  // any direction
  }
  const Points oriented = orient_normals(points, normals, nearest_neighbors(points, 16));
  EXPECT_GT(share_right(oriented.topRows(2000), sphere.normals), 0.99);
}

TEST(NormalOrientation, OfAFlatPieceIsUp) {
  const auto plane = clouds::plane(2000);
  const Points oriented = orient_normals(plane.points, -plane.normals, nearest_neighbors(plane.points, 16));
  EXPECT_TRUE((oriented.col(2).array() > 0).all());
}

TEST(NormalOrientation, IsThatOfThePointsWhereItIsKnown) {
  const auto sphere = clouds::flipped(clouds::sphere(2000));
  const Neighbors neighbors = nearest_neighbors(sphere.points, 16);
  for (Index some : {1, 7, 1999}) {
    Points given = with_random_signs(sphere.normals);
    Mask known(2000);
    for (Index i = 0; i < 2000; ++i) {
      known(i) = i % some == some - 1;
      if (known(i)) given.row(i) = sphere.normals.row(i);
    }
    EXPECT_EQ(orient_normals(sphere.points, given, neighbors, known), sphere.normals) << some;
  }
  EXPECT_THROW(orient_normals(sphere.points, sphere.normals, neighbors, Mask(Mask::Ones(3))), InvalidArgument);
}

TEST(NormalOrientation, RefusesArraysOfDifferentLengths) {
  const auto sphere = clouds::sphere(50);
  const Neighbors neighbors = nearest_neighbors(sphere.points, 4);
  EXPECT_THROW(orient_normals(sphere.points, sphere.normals.topRows(3), neighbors), InvalidArgument);
  EXPECT_THROW(agree_on_signs(sphere.points, sphere.normals.topRows(3), neighbors), InvalidArgument);
  EXPECT_THROW(orientation_consistency(sphere.points, sphere.normals, neighbors.topRows(3)), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
