// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/remeshing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

TriangleMesh remeshed(const shapes::Mesh& mesh, double edge_length) {
  RemeshingOptions options;
  options.edge_length = edge_length;
  return remesh_isotropically(mesh.vertices, mesh.faces, options);
}

/// A box of size (1, 1, 0.1), of 12 triangles, whose edges are right angles.
shapes::Mesh plate() {
  std::vector<Eigen::RowVector3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, (i >> 1) & 1, 0.1 * (i >> 2));
  return shapes::make(corners, {{0, 2, 3},
                                {0, 3, 1},
                                {4, 5, 7},
                                {4, 7, 6},
                                {0, 1, 5},
                                {0, 5, 4},
                                {2, 6, 7},
                                {2, 7, 3},
                                {0, 4, 6},
                                {0, 6, 2},
                                {1, 3, 7},
                                {1, 7, 5}});
}

/// Two tetrahedra that share vertex 0 and nothing else.
shapes::Mesh pinched() {
  return shapes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {5, 6, 0}});
}

/// A bent strip with a vertex in its middle that comes twice, a rounding error apart, and two needles between.
shapes::Mesh doubled_vertex() {
  return shapes::make({{0, 0, -1}, {0, 0, 0}, {0, 1e-17, 0}, {0, 0, 1}, {1, -2, -1}, {1, -2, 0}, {1, 2, 0}, {1, 2, 1}},
                      {{1, 6, 0}, {4, 5, 2}, {2, 1, 4}, {1, 0, 4}, {3, 7, 2}, {2, 7, 6}, {2, 6, 1}, {3, 2, 5}});
}

/// Which share of the edges is between these multiples of a length.
double share_of_edges(const TriangleMesh& mesh, double length, double least, double most) {
  Index within = 0;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const Index a = mesh.faces(f, c), b = mesh.faces(f, (c + 1) % 3);
      const double edge = (mesh.vertices.row(a) - mesh.vertices.row(b)).norm();
      within += edge >= least * length && edge <= most * length;
    }
  }
  return double(within) / double(mesh.faces.size());
}

TEST(Remeshing, CoversAClosedSurfaceWithEvenTriangles) {
  const auto torus = shapes::torus(200, 20);  // its triangles are wider than long, the more so inside
  const auto mesh = remeshed(torus, 0.1);
  const auto distance = closest_surface_points(torus.vertices, torus.faces, mesh.vertices).distance;
  EXPECT_LT(distance.maxCoeff(), 1e-9);
  EXPECT_GT(share_of_edges(mesh, 0.1, 0.6, 1.5), 0.97);
  const MeshCheck check = check_mesh(mesh.vertices, mesh.faces);
  EXPECT_TRUE(check.manifold() && check.oriented() && check.closed());
  EXPECT_EQ(check.euler_characteristic, 0);
  EXPECT_EQ(check.degenerate_faces, 0);
}

TEST(Remeshing, KeepsSharpEdgesWhereTheyAre) {
  const auto box = plate();
  const auto mesh = remeshed(box, 0.08);
  // Both ways: nothing leaves the box, and no point of its edges is cut off.
  EXPECT_LT(closest_surface_points(box.vertices, box.faces, mesh.vertices).distance.maxCoeff(), 1e-12);
  Points on_edges(4 * 50, 3);
  for (Index i = 0; i < 50; ++i) {
    const double t = (double(i) + 0.5) / 50;
    on_edges.middleRows<4>(4 * i) << t, 0, 0, t, 1, 0.1, 0, t, 0.1, 1, 1, 0.1 * t;
  }
  EXPECT_LT(closest_surface_points(mesh.vertices, mesh.faces, on_edges).distance.maxCoeff(), 1e-12);
  EXPECT_EQ(check_mesh(mesh.vertices, mesh.faces).euler_characteristic, 2);
}

TEST(Remeshing, KeepsTheBorderOfAnOpenMesh) {
  const auto mesh = remeshed(shapes::grid(1, 40), 0.1);  // needles
  const MeshCheck check = check_mesh(mesh.vertices, mesh.faces);
  EXPECT_EQ(check.boundary_loops, 1);
  EXPECT_EQ(check.euler_characteristic, 1);
  double area = 0;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1));
    area += (b - a).cross(mesh.vertices.row(mesh.faces(f, 2)) - a).z() / 2;
  }
  EXPECT_NEAR(area, 1, 1e-9);
}

TEST(Remeshing, SplitsPinchedVertices) {
  const auto mesh = remeshed(pinched(), 0.3);
  const MeshCheck check = check_mesh(mesh.vertices, mesh.faces);
  EXPECT_TRUE(check.manifold() && check.oriented() && check.closed());
  EXPECT_EQ(check.components, 2);
  EXPECT_EQ(check.euler_characteristic, 4);
}

TEST(Remeshing, JoinsVerticesThatOnlyRoundingTellsApart) {
  const auto strip = doubled_vertex();
  const auto mesh = remeshed(strip, 0.1);  // CGAL 5.5 crashes if they are two
  const MeshCheck check = check_mesh(mesh.vertices, mesh.faces);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.euler_characteristic, 1);
  EXPECT_EQ(check.degenerate_faces, 0);
  EXPECT_LT(closest_surface_points(strip.vertices, strip.faces, mesh.vertices).distance.maxCoeff(), 1e-9);
}

TEST(Remeshing, DoesTheSameTwice) {
  const auto torus = shapes::torus(60, 30);
  const auto one = remeshed(torus, 0.1), two = remeshed(torus, 0.1);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.faces, two.faces);
}

TEST(Remeshing, RefusesABadContract) {
  const auto good = shapes::tetrahedron();
  EXPECT_THROW(remeshed(good, 0), InvalidArgument);
  EXPECT_THROW(remeshed({good.vertices, Faces(0, 3)}, 0.1), InvalidArgument);
  auto bad = good;
  bad.faces(0, 0) = 4;
  EXPECT_THROW(remeshed(bad, 0.1), InvalidArgument) << "a vertex that does not exist";
  bad = good;
  bad.vertices(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(remeshed(bad, 0.1), InvalidArgument);
  bad = good;
  bad.faces.row(0) << 0, 1, 2;
  EXPECT_THROW(remeshed(bad, 0.1), InvalidArgument) << "one face is turned";
  bad = good;
  bad.faces.row(0) << 0, 0, 1;
  EXPECT_THROW(remeshed(bad, 0.1), InvalidArgument) << "a face repeats a vertex";
  const auto fan =
      shapes::make({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_THROW(remeshed(fan, 0.1), InvalidArgument) << "three faces share an edge";
}

TEST(Remeshing, RefusesMoreTrianglesThanCanBeCounted) {
  EXPECT_THROW(remeshed(shapes::tetrahedron(), 1e-6), InvalidArgument);
  EXPECT_THROW(remeshed(shapes::tetrahedron(), 1e-300), InvalidArgument);
}

TEST(Remeshing, LeavesOutVerticesWithoutAFace) {
  auto tetrahedron = shapes::tetrahedron();
  const TriangleMesh mesh = remeshed(tetrahedron, 0.3);
  tetrahedron.vertices.conservativeResize(5, 3);
  tetrahedron.vertices.row(4) << 9, 9, 9;
  const TriangleMesh same = remeshed(tetrahedron, 0.3);
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_EQ(same.faces, mesh.faces);
}

TEST(Remeshing, RefusesAMeshCollapsedToAPoint) {
  const auto tetrahedron = shapes::tetrahedron();
  RemeshingOptions options;
  options.edge_length = 0.5;
  EXPECT_THROW(remesh_isotropically(Points::Zero(4, 3), tetrahedron.faces, options), CannotReconstruct);
}

}  // namespace
}  // namespace hdpea
