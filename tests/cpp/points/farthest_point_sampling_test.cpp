// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/farthest_point_sampling.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {
namespace {

using Samples = Eigen::Vector<Index, Eigen::Dynamic>;

/// Coordinates are multiples of 1/steps: few steps make many ties and duplicates.
Coordinates random_points(Index n, Index d, unsigned steps) {
  std::mt19937_64 random(5);
  Coordinates points(n, d);
  for (double& x : points.reshaped()) x = static_cast<double>(random() % steps) / steps;
  return points;
}

/// The definition, in O(n count).
Samples by_brute_force(const Coordinates& points, Index count, Index first) {
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(points.rows(), 1e300);
  Samples samples(count);
  Index next = first;
  for (Index i = 0; i < count; ++i) {
    samples(i) = next;
    distance = distance.cwiseMin((points.rowwise() - points.row(next)).rowwise().squaredNorm());
    distance(next) = -1;
    distance.maxCoeff(&next);
  }
  return samples;
}

TEST(FarthestPointSampling, IsTheDefinitionInAnyDimension) {
  for (Index d : {1, 3, 8}) {
    const Coordinates points = random_points(500, d, 1024);
    EXPECT_EQ(farthest_point_sampling(points, 200, {17}), by_brute_force(points, 200, 17));
  }
}

TEST(FarthestPointSampling, TiesAndDuplicatesGoByIndex) {
  const Coordinates points = random_points(400, 3, 4);
  EXPECT_EQ(farthest_point_sampling(points, 400, {0}), by_brute_force(points, 400, 0));
}

TEST(FarthestPointSampling, ManyEqualPointsAreEachTakenOnce) {
  const Samples samples = farthest_point_sampling(Coordinates::Zero(20'000, 3), 20'000, {3});
  EXPECT_EQ(std::set<Index>(samples.begin(), samples.end()).size(), 20'000u);
}

TEST(FarthestPointSampling, FewerSamplesAreAPrefixOfMore) {
  const Coordinates points = random_points(300, 3, 1024);
  EXPECT_EQ(farthest_point_sampling(points, 40, {0}), farthest_point_sampling(points, 90, {0}).head(40));
}

TEST(FarthestPointSampling, GoesOnFromSamplesThatAreGiven) {
  const Coordinates points = random_points(300, 3, 1024);
  const Samples all = farthest_point_sampling(points, 90, {7});
  const std::vector<Index> given(all.begin(), all.begin() + 30);
  EXPECT_EQ(farthest_point_sampling(points, 90, given), all);
  EXPECT_THROW(farthest_point_sampling(points, 90, {3, 3}), InvalidArgument);
  EXPECT_THROW(farthest_point_sampling(points, 1, {3, 4}), InvalidArgument);
  EXPECT_THROW(farthest_point_sampling(points, 3, {}), InvalidArgument);
}

TEST(FarthestPointSampling, RefusesABadContract) {
  const Coordinates points = random_points(5, 3, 1024);
  EXPECT_THROW(farthest_point_sampling(points, 0, {0}), InvalidArgument);
  EXPECT_THROW(farthest_point_sampling(Coordinates(50, 0), 2, {0}), InvalidArgument);
  EXPECT_THROW(farthest_point_sampling(points, 6, {0}), InvalidArgument);
  EXPECT_THROW(farthest_point_sampling(points, 2, {5}), InvalidArgument);
  EXPECT_THROW(farthest_point_sampling(points, 2, {-1}), InvalidArgument);
}

TEST(FarthestPointSampling, CanBeCancelled) {
  EXPECT_THROW(farthest_point_sampling(random_points(5, 3, 8), 2, {0}, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace hdpea
