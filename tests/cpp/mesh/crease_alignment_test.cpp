// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/crease_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/crease_edges.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

/// The grid folded by a right angle along x = 0.45, where none of its vertices lie.
shapes::Mesh folded_grid() {
  auto grid = shapes::grid(10, 10);
  for (Index v = 0; v < grid.vertices.rows(); ++v) {
    const double beyond = grid.vertices(v, 0) - 0.45;
    if (beyond > 0) grid.vertices.row(v) << 0.45, grid.vertices(v, 1), -beyond;
  }
  return grid;
}

/// Its crease, with samples so many spacings apart.
Creases fold(double spacing = 0.04, double apart = 0.5) {
  Creases creases;
  for (double y = 0; y <= 1; y += apart * spacing) {
    creases.samples.push_back({{0.45, y, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, true, spacing, 0, true});
  }
  return creases;
}

/// How many faces have corners on both sides of the fold.
Index faces_across(const TriangleMesh& mesh) {
  Index across = 0;
  for (const auto& face : mesh.faces.rowwise()) {
    bool first = false, second = false;
    for (Index v : face) {
      first = first || mesh.vertices(v, 0) < 0.45 - 1e-9;
      second = second || mesh.vertices(v, 2) < -1e-9;
    }
    across += first && second;
  }
  return across;
}

TEST(CreaseAlignment, LeavesNoEdgeAcrossTheCrease) {
  const auto grid = folded_grid();
  const TriangleMesh aligned = align_to_creases(grid.vertices, grid.faces, fold());
  EXPECT_EQ(faces_across(aligned), 0);
  EXPECT_GT(crease_edges(aligned.vertices, aligned.faces, fold()).rows(), 7);
}

TEST(CreaseAlignment, ReachesAcrossGapsBetweenSamples) {
  const auto grid = folded_grid();
  EXPECT_EQ(faces_across(align_to_creases(grid.vertices, grid.faces, fold(0.04, 2.75))), 0);
}

TEST(CreaseAlignment, LeavesVerticesThatAreManySpacingsOff) {
  const auto grid = folded_grid();
  EXPECT_EQ(align_to_creases(grid.vertices, grid.faces, fold(0.01)).vertices, grid.vertices);
}

TEST(CreaseAlignment, TakesAVertexOutOfTheAirInFrontOfTheCrease) {
  const auto grid = folded_grid();
  TriangleMesh mesh = align_to_creases(grid.vertices, grid.faces, fold());
  Index v = 0;
  const auto on_crease = [&](Index i) { return std::hypot(mesh.vertices(i, 0) - 0.45, mesh.vertices(i, 2)) < 1e-9; };
  while (!on_crease(v) || std::abs(mesh.vertices(v, 1) - 0.5) > 0.1) ++v;
  // As far in front of one side as of the other, so that none of its edges crosses.
  mesh.vertices(v, 0) += 0.04;
  mesh.vertices(v, 2) = mesh.vertices(v, 0) - 0.45;
  mesh = align_to_creases(mesh.vertices, mesh.faces, fold());
  EXPECT_TRUE(on_crease(v));
}

TEST(CreaseAlignment, KeepsTheTopology) {
  const auto grid = folded_grid();
  const TriangleMesh aligned = align_to_creases(grid.vertices, grid.faces, fold());
  const MeshCheck before = check_mesh(grid.vertices, grid.faces), after = check_mesh(aligned.vertices, aligned.faces);
  EXPECT_TRUE(after.manifold() && after.oriented());
  EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
  EXPECT_EQ(after.boundary_loops, before.boundary_loops);
}

TEST(CreaseAlignment, WithoutCreasesChangesNothing) {
  const auto grid = folded_grid();
  const TriangleMesh same = align_to_creases(grid.vertices, grid.faces, {});
  EXPECT_EQ(same.vertices, grid.vertices);
  EXPECT_EQ(same.faces, grid.faces);
  EXPECT_EQ(crease_edges(grid.vertices, grid.faces, {}).rows(), 0);
}

TEST(CreaseAlignment, RefusesFacesOfVerticesThatDoNotExist) {
  auto grid = folded_grid();
  grid.faces(0, 0) = grid.vertices.rows();
  EXPECT_THROW(align_to_creases(grid.vertices, grid.faces, fold()), InvalidArgument);
  EXPECT_THROW(crease_edges(grid.vertices, grid.faces, fold()), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
