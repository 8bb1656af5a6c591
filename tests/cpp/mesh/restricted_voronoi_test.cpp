// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/restricted_voronoi.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

Candidates candidates_of(const clouds::Cloud& cloud, double radius) {
  const Index n = cloud.points.rows();
  return restricted_voronoi_candidates(cloud.points, tangent_bases_across(cloud.normals),
                                       nearest_neighbors(cloud.points, 40), Eigen::VectorXd::Constant(n, radius));
}

TEST(RestrictedVoronoi, OfADenseSphereIsItsDelaunayTriangulation) {
  const auto sphere = clouds::sphere(2000);
  const Candidates candidates = candidates_of(sphere, 0.15);
  const Index t3 = (candidates.counts.array() == 3).count();
  EXPECT_NEAR(double(t3), 2 * 2000 - 4, 0.02 * 4000);
  EXPECT_NEAR(candidates.cell_areas.sum(), 4 * std::numbers::pi, 0.02 * 4 * std::numbers::pi);
}

TEST(RestrictedVoronoi, CellsOfAPlaneTileIt) {
  // Inside, cells tile the square exactly; those of the border reach out by less than their radius.
  const auto plane = clouds::plane(2000);
  const double radius = 0.06;
  const double area = candidates_of(plane, radius).cell_areas.sum();
  EXPECT_GT(area, 1);
  EXPECT_LT(area, (1 + 2 * radius) * (1 + 2 * radius));
}

TEST(RestrictedVoronoi, IsTheSameInMoreDimensions) {
  // The plane turned into R^8: only dot products enter, so the triangles are the same.
  const auto plane = clouds::plane(500);
  Coordinates turned = Coordinates::Zero(500, 8);
  turned.col(7) = plane.points.col(0);
  turned.col(2) = plane.points.col(1);
  Coordinates bases = Coordinates::Zero(500, 16);
  bases.col(7).setOnes();
  bases.col(8 + 2).setOnes();
  const auto radii = Eigen::VectorXd::Constant(500, 0.1);
  const Candidates in_8 = restricted_voronoi_candidates(turned, bases, nearest_neighbors(turned, 40), radii);
  const Candidates in_3 = candidates_of(plane, 0.1);
  EXPECT_EQ(in_8.triangles, in_3.triangles);
  EXPECT_EQ(in_8.counts, in_3.counts);
}

TEST(RestrictedVoronoi, ASmallDiskLeavesNothingToJoin) {
  const Candidates candidates = candidates_of(clouds::sphere(500), 1e-3);
  EXPECT_EQ(candidates.triangles.rows(), 0);
}

TEST(RestrictedVoronoi, SurvivesDuplicateSeeds) {
  auto cloud = clouds::sphere(500);
  cloud.points.row(1) = cloud.points.row(0);
  EXPECT_TRUE(candidates_of(cloud, 0.3).cell_areas.allFinite());
}

TEST(RestrictedVoronoi, RefusesABadContract) {
  EXPECT_THROW(candidates_of(clouds::sphere(100), 0), InvalidArgument);
  const auto sphere = clouds::sphere(10);
  const Coordinates bases = tangent_bases_across(sphere.normals);
  const Eigen::VectorXd radii = Eigen::VectorXd::Ones(10);
  const Neighbors none = Neighbors::Constant(10, 4, -1);
  EXPECT_EQ(restricted_voronoi_candidates(sphere.points, bases, none, radii).triangles.rows(), 0);
  for (Index bad : {Index{10}, Index{1000000}, Index{-2}}) {
    EXPECT_THROW(restricted_voronoi_candidates(sphere.points, bases, Neighbors::Constant(10, 4, bad), radii),
                 InvalidArgument);
  }
  EXPECT_THROW(restricted_voronoi_candidates(sphere.points, bases, none.topRows(9), radii), InvalidArgument);
  EXPECT_THROW(restricted_voronoi_candidates(sphere.points, bases.leftCols(4), none, radii), InvalidArgument);
  EXPECT_THROW(restricted_voronoi_candidates(sphere.points, bases, none, radii.head(9)), InvalidArgument);
  EXPECT_THROW(restricted_voronoi_candidates(sphere.points, bases * HUGE_VAL, none, radii), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
