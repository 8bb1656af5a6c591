// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/contrary_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

/// The points of a cloud below a height.
clouds::Cloud below(const clouds::Cloud& cloud, double height) {
  std::vector<Index> rows;
  for (Index i = 0; i < cloud.points.rows(); ++i) {
    if (cloud.points(i, 2) < height) rows.push_back(i);
  }
  return {cloud.points(rows, Eigen::all), cloud.normals(rows, Eigen::all)};
}

/// A thick bowl, of which the inside was seen at its bottom alone: nothing joins it to the outside.
struct Bowl {
  clouds::Cloud outside = below(clouds::sphere(4000), 0);
  clouds::Cloud bottom = clouds::flipped(below(clouds::sphere(2500, 0.65), -0.3));
  clouds::Cloud all = clouds::joined(outside, bottom);
  Neighbors neighbors = nearest_neighbors(all.points, 12);
};

TEST(ContraryPieces, AreTurned) {
  const Bowl bowl;
  const Points wrong = clouds::joined(bowl.outside, clouds::flipped(bowl.bottom)).normals;
  EXPECT_EQ(turn_contrary_pieces(bowl.all.points, wrong, bowl.neighbors), bowl.all.normals);
  EXPECT_EQ(turn_contrary_pieces(bowl.all.points, -wrong, bowl.neighbors), -bowl.all.normals);
}

TEST(ContraryPieces, AreNotThoseThatAgree) {
  const Bowl bowl;
  EXPECT_EQ(turn_contrary_pieces(bowl.all.points, bowl.all.normals, bowl.neighbors), bowl.all.normals);
}

TEST(ContraryPieces, ThatAreTinyStay) {
  Bowl bowl;
  bowl.bottom = clouds::flipped(below(clouds::sphere(2500, 0.65), -0.64));
  ASSERT_LT(bowl.bottom.points.rows(), 24);
  const clouds::Cloud wrong = clouds::joined(bowl.outside, clouds::flipped(bowl.bottom));
  EXPECT_EQ(turn_contrary_pieces(wrong.points, wrong.normals, nearest_neighbors(wrong.points, 12)), wrong.normals);
}

TEST(ContraryPieces, AreNotThingsBesideOthers) {
  clouds::Cloud beside = clouds::joined(clouds::sphere(3000), clouds::sphere(800, 0.5));
  beside.points.bottomRows(800).col(0).array() += 1.8;
  const Neighbors neighbors = nearest_neighbors(beside.points, 12);
  EXPECT_EQ(turn_contrary_pieces(beside.points, beside.normals, neighbors), beside.normals);
  // Outside of a closed thing nothing shows whether another is inside out.
  beside.normals.bottomRows(800) *= -1;
  EXPECT_EQ(turn_contrary_pieces(beside.points, beside.normals, neighbors), beside.normals);
}

}  // namespace
}  // namespace hdpea
