// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/neighbors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {
namespace {

Coordinates random_points(Index n, Index d, unsigned seed) {
  std::mt19937_64 random(seed);
  Coordinates points(n, d);
  for (double& x : points.reshaped()) x = static_cast<double>(random() % 1000) / 1000;
  return points;
}

/// All other points by (distance, index), the slow way.
std::vector<Index> by_brute_force(const Coordinates& points, Index i, Index k) {
  std::vector<std::pair<double, Index>> all;
  for (Index j = 0; j < points.rows(); ++j) {
    if (j != i) all.emplace_back((points.row(i) - points.row(j)).squaredNorm(), j);
  }
  std::sort(all.begin(), all.end());
  std::vector<Index> nearest;
  for (Index j = 0; j < k; ++j) nearest.push_back(all[j].second);
  return nearest;
}

TEST(Neighbors, AgreeWithBruteForceInAnyDimension) {
  for (Index d : {2, 3, 8}) {
    const Coordinates points = random_points(300, d, 7);
    const Neighbors neighbors = nearest_neighbors(points, 9);
    for (Index i = 0; i < points.rows(); ++i) {
      const auto expected = by_brute_force(points, i, 9);
      for (Index j = 0; j < 9; ++j) EXPECT_EQ(neighbors(i, j), expected[j]);
    }
  }
}

TEST(Neighbors, BreakTiesByIndexOnARegularGrid) {
  Coordinates grid(100, 2);
  for (Index i = 0; i < 100; ++i) grid.row(i) << static_cast<double>(i % 10), static_cast<double>(i / 10);
  const Neighbors neighbors = nearest_neighbors(grid, 3);
  EXPECT_EQ(neighbors(55, 0), 45);
  EXPECT_EQ(neighbors(55, 1), 54);
  EXPECT_EQ(neighbors(55, 2), 56);
}

TEST(Neighbors, PadShortRows) {
  const Coordinates points = random_points(3, 3, 1);
  const Neighbors neighbors = nearest_neighbors(points, 5);
  EXPECT_TRUE((neighbors.leftCols(2).array() >= 0).all());
  EXPECT_TRUE((neighbors.rightCols(3).array() == -1).all());
}

TEST(Neighbors, AQueryAtAPointFindsIt) {
  const Coordinates points = random_points(50, 3, 2);
  const Neighbors nearest = nearest_neighbors(points, points, 1);
  for (Index i = 0; i < 50; ++i) EXPECT_EQ((points.row(nearest(i, 0)) - points.row(i)).norm(), 0);
}

TEST(Neighbors, RefuseDistancesThatOverflow) {
  const Coordinates points = random_points(5, 3, 1), far = 1e160 * points;
  EXPECT_THROW(nearest_neighbors(far, 2), InvalidArgument);
  EXPECT_THROW(nearest_neighbors(points, far, 2), InvalidArgument);
  EXPECT_TRUE((nearest_neighbors(1e150 * points, -1e150 * points, 2).array() >= 0).all());
}

TEST(Neighbors, RefuseABadContract) {
  const Coordinates points = random_points(5, 3, 1);
  EXPECT_THROW(nearest_neighbors(points, 0), InvalidArgument);
  EXPECT_THROW(nearest_neighbors(Coordinates(0, 3), 1), InvalidArgument);
  EXPECT_THROW(nearest_neighbors(Coordinates(5, 0), 1), InvalidArgument);
  EXPECT_THROW(nearest_neighbors(points, random_points(2, 8, 1), 1), InvalidArgument);
}

TEST(Neighbors, OneTreeFindsTheNearestAgainAndAgain) {
  const Points points = random_points(300, 3, 7);
  const NearestPoints nearest(points);
  for (const Points& places : {Points(random_points(70, 3, 1)), Points(random_points(9, 3, 2)), points}) {
    EXPECT_EQ(nearest.to(places), nearest_neighbors(points, places, 1).col(0));
  }
  EXPECT_THROW(NearestPoints(Points(0, 3)), InvalidArgument);
  EXPECT_THROW(nearest.to(Points::Constant(1, 3, NAN)), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
