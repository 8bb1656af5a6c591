// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/sheets.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

Neighbors sheet_of(const clouds::Cloud& cloud, Index k = 40) {
  return sheet_neighbors(cloud.points, cloud.normals, nearest_neighbors(cloud.points, k));
}

/// Whether any point of the first half has a neighbour in the second, among points that `counts`.
template <class Counts>
bool halves_touch(const Neighbors& neighbors, Counts counts) {
  const Index half = neighbors.rows() / 2;
  for (Index i = 0; i < half; ++i) {
    for (Index j : neighbors.row(i)) {
      if (j >= half && counts(i)) return true;
    }
  }
  return false;
}

TEST(Sheets, KeepEveryNeighborOnASmoothSurface) {
  const auto sphere = clouds::sphere(2000);
  EXPECT_EQ(sheet_of(sphere, 12), nearest_neighbors(sphere.points, 12));
}

TEST(Sheets, TheTwoSidesOfAWallDoNotSeeEachOther) {
  // 2,500 points in a unit square have a spacing of 0.02; the wall is three spacings thick.
  const auto wall = clouds::joined(clouds::plane(2500), clouds::flipped(clouds::plane(2500, -0.06)));
  EXPECT_FALSE(halves_touch(sheet_of(wall), [](Index) { return true; }));
}

TEST(Sheets, ParallelSheetsThatFaceTheSameWayDoNotSeeEachOther) {
  // Of the neighbours that tangents are made of; the far ones of a corner see the other sheet at a slant.
  const auto sheets = clouds::joined(clouds::plane(2500), clouds::plane(2500, -0.06));
  EXPECT_FALSE(halves_touch(sheet_of(sheets, 12), [](Index) { return true; }));
}

TEST(Sheets, TheTwoSidesOfAKnifesEdgeMeetAtTheEdgeOnly) {
  // Two squares that meet along x = 0 at an angle of 20 degrees.
  auto upper = clouds::plane(2500), lower = clouds::plane(2500);
  const double angle = std::numbers::pi / 18;
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  upper.points = upper.points * tilt;
  upper.normals = upper.normals * tilt;
  lower.points = lower.points * tilt.transpose();
  lower.normals = -lower.normals * tilt.transpose();
  const auto knife = clouds::joined(upper, lower);
  const Neighbors neighbors = sheet_of(knife);
  EXPECT_TRUE(halves_touch(neighbors, [&](Index i) { return knife.points(i, 0) < 0.03; }));
  EXPECT_FALSE(halves_touch(neighbors, [&](Index i) {
    return knife.points(i, 0) > 0.1 && knife.points(i, 0) < 0.9 && std::abs(knife.points(i, 1) - 0.5) < 0.4;
  }));
}

TEST(Sheets, BlendedNormalsOfASphereAreItsNormals) {
  const auto sphere = clouds::sphere(4000);
  const Points blended = blended_normals(sphere.normals, sheet_of(sphere));
  EXPECT_LT((blended - sphere.normals).rowwise().norm().maxCoeff(), 0.05);
}

TEST(Sheets, RefuseArraysOfDifferentLengths) {
  const auto sphere = clouds::sphere(100);
  EXPECT_THROW(sheet_neighbors(sphere.points, sphere.normals.topRows(5), nearest_neighbors(sphere.points, 4)),
               InvalidArgument);
}

}  // namespace
}  // namespace hdpea
