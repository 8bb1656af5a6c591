// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/editable_mesh.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

MeshCheck check(const EditableMesh& mesh) {
  const TriangleMesh arrays = mesh.mesh();
  EXPECT_EQ(arrays.vertices.rows(), mesh.vertices_left());
  EXPECT_EQ(arrays.faces.rows(), mesh.faces_left());
  return check_mesh(arrays.vertices, arrays.faces);
}

/// Collapses random edges that may be, until hardly any is left.
void collapse_at_random(EditableMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  for (int attempt = 0; attempt < 3000; ++attempt) {
    const std::vector<Index> left = mesh.left();
    const Index a = left[random() % left.size()];
    const std::vector<Index> around = mesh.neighbors(a);
    const Index b = around[random() % around.size()];
    if (mesh.may_collapse(a, b)) mesh.collapse(a, b, (mesh.position(a) + mesh.position(b)) / 2);
  }
}

TEST(EditableMesh, CollapsesKeepTheTopology) {
  for (const auto& shape : {shapes::torus(12, 8), shapes::sphere(6, 8), shapes::grid(7, 7)}) {
    const MeshCheck before = check_mesh(shape.vertices, shape.faces);
    for (unsigned seed = 0; seed < 4; ++seed) {
      EditableMesh mesh(shape.vertices, shape.faces);
      collapse_at_random(mesh, seed);
      const MeshCheck after = check(mesh);
      EXPECT_TRUE(after.manifold() && after.oriented());
      EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
      EXPECT_EQ(after.boundary_loops, before.boundary_loops);
      EXPECT_LT(mesh.faces_left(), shape.faces.rows() / 4);
    }
  }
}

TEST(EditableMesh, NothingSmallerThanATetrahedronIsLeft) {
  const auto shape = shapes::tetrahedron();
  const EditableMesh mesh(shape.vertices, shape.faces);
  for (Index v : mesh.neighbors(0)) EXPECT_FALSE(mesh.may_collapse(0, v));
}

TEST(EditableMesh, SplitsKeepTheTopology) {
  for (const auto& shape : {shapes::torus(12, 8), shapes::grid(4, 4)}) {
    const MeshCheck before = check_mesh(shape.vertices, shape.faces);
    EditableMesh mesh(shape.vertices, shape.faces);
    mesh.split(3, mesh.position(mesh.corners(3)[0]) + Eigen::Vector3d(0, 0, 0.1));
    mesh.split_edge(mesh.corners(0)[0], mesh.corners(0)[1], mesh.position(mesh.corners(0)[0]) * 1.01);
    const MeshCheck after = check(mesh);
    EXPECT_TRUE(after.manifold() && after.oriented());
    EXPECT_EQ(after.vertices, before.vertices + 2);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
    EXPECT_EQ(after.boundary_loops, before.boundary_loops);
  }
}

}  // namespace
}  // namespace hdpea
