// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/wnnc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

struct Case {
  const char* name;
  clouds::Cloud cloud;
  double right;  ///< share of the normals that face the way the true ones do
};

class Wnnc : public testing::TestWithParam<Case> {};

/// Share of the normals within 90 degrees of the truth.
double share_right(const Points& normals, const Points& truth) {
  return ((normals.array() * truth.array()).rowwise().sum() > 0).cast<double>().mean();
}

TEST_P(Wnnc, FacesOutOfWhatThePointsEnclose) {
  const auto& [points, truth] = GetParam().cloud;
  const Points normals = wnnc_normals(points);
  EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_GE(share_right(normals, truth), GetParam().right);
}

TEST_P(Wnnc, KnowsNoScaleAndNoOrigin) {
  const auto& [points, truth] = GetParam().cloud;
  const Points moved = (1000 * points).rowwise() + Eigen::RowVector3d(3000, -5000, 7000);
  EXPECT_GE(share_right(wnnc_normals(moved), truth), GetParam().right);
}

clouds::Cloud shifted(clouds::Cloud cloud, double x) {
  cloud.points.col(0).array() += x;
  return cloud;
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Wnnc,
    testing::Values(Case{"sphere", clouds::sphere(2000), 1}, Case{"torus", clouds::torus(3000), 1},
                    Case{"cube", clouds::cube(500), 0.999}, Case{"thin_plate", clouds::thin_plate(), 0.999},
                    Case{"two_spheres", clouds::joined(clouds::sphere(1500), shifted(clouds::sphere(1500), 2.5)), 1},
                    Case{"nested", clouds::joined(clouds::sphere(3000), clouds::flipped(clouds::sphere(1500, 0.6))),
                         1}),
    [](const auto& each) { return each.param.name; });

TEST(WnncNormals, OfASphereAreThoseOfTheSphere) {
  const auto sphere = clouds::sphere(4000);
  EXPECT_GT((wnnc_normals(sphere.points).array() * sphere.normals.array()).rowwise().sum().minCoeff(), 0.98);
}

TEST(WnncNormals, OfNoiseNeedAWidthOfTwiceIt) {
  const auto sphere = clouds::sphere(1500);
  const double spacing = std::sqrt(4 * std::numbers::pi / 1500);
  std::mt19937 random(0);
  std::normal_distribution<double> noise(0, 1.5 * spacing);
  const Points points = sphere.points + Points::NullaryExpr(1500, 3, [&] { return noise(random); });
  EXPECT_GT(share_right(wnnc_normals(points, {.spacings_wide = 3.25}), sphere.normals), 0.995);
  EXPECT_LT(share_right(wnnc_normals(points), sphere.normals), 0.8);
}

TEST(WnncNormals, DoNotDependOnTheThreads) {
  const Points points = clouds::thin_plate(500).points;
  set_thread_limit(1);
  const Points alone = wnnc_normals(points);
  set_thread_limit(0);
  EXPECT_EQ(wnnc_normals(points), alone);
}

TEST(WnncNormals, AreThoseOfThePointsInAnyOrder) {
  const Points points = clouds::thin_plate(500).points;
  std::vector<Index> backwards(static_cast<std::size_t>(points.rows()));
  std::iota(backwards.rbegin(), backwards.rend(), Index{0});
  const Points reversed = wnnc_normals(points(backwards, Eigen::all));
  EXPECT_LT((reversed - wnnc_normals(points)(backwards, Eigen::all)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(WnncNormals, OfVeryFewPointsAreUnitVectors) {
  for (Index n : {1, 2, 5, 17}) {
    const Points normals = wnnc_normals(clouds::sphere(n).points);
    EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
  }
}

TEST(WnncNormals, TellHowFarTheyAre) {
  std::vector<double> told;
  wnnc_normals(clouds::sphere(200).points, {}, [&](double fraction) {
    told.push_back(fraction);
    return true;
  });
  EXPECT_EQ(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(WnncNormals, CanBeCancelled) {
  EXPECT_THROW(wnnc_normals(clouds::sphere(200).points, {}, [](double fraction) { return fraction < 0.5; }), Cancelled);
}

TEST(WnncNormals, RefuseWhatIsIllegal) {
  const Points points = clouds::sphere(50).points;
  EXPECT_THROW(wnnc_normals(Points(0, 3)), InvalidArgument);
  EXPECT_THROW(wnnc_normals(Points::Constant(20, 3, std::nan(""))), InvalidArgument);
  EXPECT_THROW(wnnc_normals(points, {.iterations = 0}), InvalidArgument);
  EXPECT_THROW(wnnc_normals(points, {.first_width = 0}), InvalidArgument);
  EXPECT_THROW(wnnc_normals(points, {.spacings_wide = 0}), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
