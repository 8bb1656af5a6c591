// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/intersection_repair.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/self_intersections.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

const Points kNoPoints(0, 3);

TEST(IntersectionRepair, LeavesAMeshAloneInWhichNoFaceCutsAnother) {
  const auto torus = shapes::torus(30, 15);
  const RepairedMesh same = repair_self_intersections(torus.vertices, torus.faces, kNoPoints, 0);
  EXPECT_EQ(same.vertices, torus.vertices);
  EXPECT_EQ(same.faces, torus.faces);
}

TEST(IntersectionRepair, TakesBackAVertexThatWentThroughTheFacesBesideIt) {
  auto grid = shapes::grid(10, 10);
  // Vertex 60 lies inside: pushed beyond the vertices two steps away it folds its faces over theirs.
  grid.vertices.row(60) += Eigen::RowVector3d(0.25, 0.03, 0);
  ASSERT_GT(count_self_intersections(grid.vertices, grid.faces), 0);
  const RepairedMesh repaired = repair_self_intersections(grid.vertices, grid.faces, kNoPoints, 0);
  EXPECT_EQ(count_self_intersections(repaired.vertices, repaired.faces), 0);
  const MeshCheck check = check_mesh(repaired.vertices, repaired.faces);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.boundary_loops, 1);
  EXPECT_EQ(check.components, 1);
}

TEST(IntersectionRepair, RefusesABrokenMesh) {
  const auto grid = shapes::grid(2, 2);
  Faces twice(grid.faces.rows() + 1, 3);
  twice << grid.faces, grid.faces.row(0);
  EXPECT_THROW(repair_self_intersections(grid.vertices, twice, kNoPoints, 0), InvalidArgument);
  EXPECT_THROW(repair_self_intersections(grid.vertices, grid.faces, kNoPoints, -1), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
