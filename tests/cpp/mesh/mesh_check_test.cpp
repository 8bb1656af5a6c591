// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/mesh_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/self_intersections.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

using shapes::Mesh;

MeshCheck check(const Mesh& mesh) { return check_mesh(mesh.vertices, mesh.faces); }

/// Two tetrahedra, the second moved; they share the vertices listed as (of the second, of the first).
Mesh two_tetrahedra(const std::vector<std::pair<Index, Index>>& shared, const Eigen::RowVector3d& shift) {
  const Mesh one = shapes::tetrahedron();
  Mesh both{Points(8, 3), Faces(8, 3)};
  both.vertices << one.vertices, one.vertices.rowwise() + shift;
  both.faces << one.faces, one.faces.array() + 4;
  for (const auto& [second, first] : shared) {
    for (Index& v : both.faces.reshaped()) v = v == 4 + second ? first : v;
  }
  return both;
}

TEST(MeshCheck, ATetrahedronIsASphere) {
  const MeshCheck found = check(shapes::tetrahedron());
  EXPECT_TRUE(found.manifold() && found.oriented() && found.closed());
  EXPECT_EQ(found.edges, 6);
  EXPECT_EQ(found.euler_characteristic, 2);
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.genus(), 0);
}

TEST(MeshCheck, ATorusHasOneHandle) {
  const MeshCheck found = check(shapes::torus(8, 5));
  EXPECT_TRUE(found.manifold() && found.oriented() && found.closed());
  EXPECT_EQ(found.euler_characteristic, 0);
  EXPECT_EQ(found.genus(), 1);
}

TEST(MeshCheck, AGridHasOneBoundaryLoop) {
  const MeshCheck found = check(shapes::grid(3, 4));
  EXPECT_TRUE(found.manifold() && found.oriented());
  EXPECT_FALSE(found.closed());
  EXPECT_EQ(found.boundary_edges, 14);
  EXPECT_EQ(found.boundary_loops, 1);
  EXPECT_EQ(found.genus(), 0);
}

TEST(MeshCheck, ASphereWithoutPolesHasTwoLoops) {
  const MeshCheck found = check(shapes::without_vertices(shapes::sphere(5, 12), {0, 61}));
  EXPECT_EQ(found.boundary_loops, 2);
  EXPECT_EQ(found.unreferenced_vertices, 2);
  EXPECT_EQ(found.euler_characteristic, 0);
  EXPECT_EQ(found.genus(), 0);
}

TEST(MeshCheck, HolesThatTouchInAPinchedVertexAreOneLoop) {
  // On a 6 x 6 grid the holes around vertices (2, 3) and (4, 3) touch in (3, 3).
  const MeshCheck found = check(shapes::without_vertices(shapes::grid(6, 6), {2 * 7 + 3, 4 * 7 + 3}));
  EXPECT_EQ(found.nonmanifold_vertices, 1);
  EXPECT_EQ(found.boundary_loops, 2);
}

TEST(MeshCheck, TetrahedraThatShareAVertexOrAnEdgeAreNotManifold) {
  const MeshCheck vertex = check(two_tetrahedra({{0, 3}}, {0, 0, 1}));
  EXPECT_EQ(vertex.nonmanifold_vertices, 1);
  EXPECT_EQ(vertex.nonmanifold_edges, 0);
  EXPECT_EQ(vertex.components, 2);
  EXPECT_FALSE(vertex.genus().has_value());
  const MeshCheck edge = check(two_tetrahedra({{0, 3}, {1, 2}}, {0, 0, 1}));
  EXPECT_EQ(edge.nonmanifold_edges, 1);
  EXPECT_EQ(edge.nonmanifold_vertices, 2);
}

TEST(MeshCheck, AFlippedFaceIsInconsistent) {
  Mesh mesh = shapes::tetrahedron();
  std::swap(mesh.faces(0, 0), mesh.faces(0, 1));
  EXPECT_EQ(check(mesh).inconsistent_edges, 3);
  EXPECT_FALSE(check(mesh).oriented());
  EXPECT_TRUE(check(mesh).manifold());
}

TEST(MeshCheck, CountsDegenerateAndDuplicateFaces) {
  Mesh mesh = shapes::grid(2, 2);
  Faces faces(mesh.faces.rows() + 3, 3);
  faces << mesh.faces, 0, 1, 2, 4, 4, 5, mesh.faces(0, 1), mesh.faces(0, 2), mesh.faces(0, 0);
  const MeshCheck found = check_mesh(mesh.vertices, faces);
  EXPECT_EQ(found.degenerate_faces, 2);
  EXPECT_EQ(found.repeated_index_faces, 1);
  EXPECT_EQ(found.duplicate_faces, 1);
  EXPECT_FALSE(found.manifold());
}

TEST(MeshCheck, AnEmptyMeshIsManifoldButNotClosed) {
  const MeshCheck found = check_mesh(Points(0, 3), Faces(0, 3));
  EXPECT_TRUE(found.manifold() && found.oriented());
  EXPECT_FALSE(found.closed());
}

TEST(MeshCheck, RefusesABadContract) {
  Mesh mesh = shapes::tetrahedron();
  mesh.faces(1, 1) = 4;
  EXPECT_THROW(check(mesh), InvalidArgument);
  EXPECT_THROW(count_self_intersections(mesh.vertices, mesh.faces), InvalidArgument);
  mesh.faces(1, 1) = -1;
  EXPECT_THROW(check(mesh), InvalidArgument);
  mesh = shapes::tetrahedron();
  mesh.vertices(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check(mesh), InvalidArgument);
  EXPECT_THROW(count_self_intersections(mesh.vertices, mesh.faces), InvalidArgument);
}

TEST(SelfIntersections, CleanMeshesHaveNone) {
  for (const Mesh& mesh : {shapes::tetrahedron(), shapes::torus(12, 8), shapes::grid(5, 5), shapes::sphere(6, 9)}) {
    EXPECT_EQ(count_self_intersections(mesh.vertices, mesh.faces), 0);
  }
}

TEST(SelfIntersections, FindAStabbedFace) {
  const Mesh mesh =
      shapes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.2, .2, -1}, {.2, .2, 1}, {2, 2, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(count_self_intersections(mesh.vertices, mesh.faces), 1);
}

TEST(SelfIntersections, FindFoldsOverASharedEdgeAndASharedVertex) {
  const Points vertices =
      shapes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {.4, .4, 0}}, {}).vertices;
  Faces edge(2, 3), opened(2, 3), vertex(2, 3), duplicate(2, 3);
  edge << 0, 1, 2, 1, 0, 3;
  opened << 0, 1, 2, 1, 0, 4;
  vertex << 0, 1, 2, 0, 4, 5;
  duplicate << 0, 1, 2, 1, 0, 2;
  EXPECT_EQ(count_self_intersections(vertices, edge), 1);
  EXPECT_EQ(count_self_intersections(vertices, opened), 0);
  EXPECT_EQ(count_self_intersections(vertices, vertex), 1);
  EXPECT_EQ(count_self_intersections(vertices, duplicate), 1);
}

}  // namespace
}  // namespace hdpea
