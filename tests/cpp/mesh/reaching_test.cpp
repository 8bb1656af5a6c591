// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/reaching.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

constexpr double kFar = 0.1;

/// Points of the grid's plane, and some of a fin that stands on its far edge beyond it.
Points with_rim(double width) {
  constexpr Index along = 40, across = 44;
  Points points(along * across, 3);
  for (Index i = 0; i < along; ++i) {
    for (Index j = 0; j < across; ++j) {
      points.row(i * across + j) << (double(i) + 0.5) / along, double(j) / (across - 1) * (1 + width), 0;
    }
  }
  return points;
}

Points facing(const Points& points, double z) {
  Points normals = Points::Zero(points.rows(), 3);
  normals.col(2).setConstant(z);
  return normals;
}

TEST(Reaching, ReturnsAMeshAsItIsThatIsFarFromNoPoint) {
  const auto grid = shapes::grid(10, 10);
  const Points points = with_rim(0.09);
  const ReachedMesh same = reach_points(grid.vertices, grid.faces, points, facing(points, 1), kFar);
  EXPECT_EQ(same.vertices, grid.vertices);
  EXPECT_EQ(same.faces, grid.faces);
  EXPECT_EQ(same.reached.size(), 0);
}

TEST(Reaching, BringsBackARimThatWasMissing) {
  const auto grid = shapes::grid(10, 10);
  const Points points = with_rim(0.3);
  const ReachedMesh reached = reach_points(grid.vertices, grid.faces, points, facing(points, 1), kFar);
  const auto before = closest_surface_points(grid.vertices, grid.faces, points).distance;
  const auto after = closest_surface_points(reached.vertices, reached.faces, points).distance;
  EXPECT_LT(after.maxCoeff(), 0.5 * before.maxCoeff());
  EXPECT_LT((after.array() > kFar).count(), (before.array() > kFar).count() / 10);
  ASSERT_EQ(reached.vertices.rows(), grid.vertices.rows() + reached.reached.size());
  EXPECT_EQ(reached.vertices.bottomRows(reached.reached.size()), Points(points(reached.reached, Eigen::all)));
  const MeshCheck check = check_mesh(reached.vertices, reached.faces);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.boundary_loops, 1);
  EXPECT_EQ(check.euler_characteristic, 1);
}

TEST(Reaching, ReachesNoPointsOfTheFarSideOfAWall) {
  const auto grid = shapes::grid(10, 10);
  const Points points = with_rim(0.3);
  const ReachedMesh same = reach_points(grid.vertices, grid.faces, points, facing(points, -1), kFar);
  EXPECT_EQ(same.vertices, grid.vertices);
}

TEST(Reaching, RefusesWhatBreaksTheContract) {
  const auto grid = shapes::grid(2, 2);
  const Points points = with_rim(0.3), normals = facing(points, 1);
  EXPECT_THROW(reach_points(grid.vertices, grid.faces, points, normals, 0), InvalidArgument);
  EXPECT_THROW(reach_points(grid.vertices, grid.faces, points, normals.topRows(3), kFar), InvalidArgument);
  Faces twice(grid.faces.rows() + 1, 3);
  twice << grid.faces, grid.faces.row(0);
  EXPECT_THROW(reach_points(grid.vertices, twice, points, normals, kFar), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
