// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/hole_filling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

constexpr double kEverything = std::numeric_limits<double>::infinity();

/// The faces of a mesh without those whose centre `is_hole`.
template <class IsHole>
Faces without(const shapes::Mesh& mesh, IsHole is_hole) {
  std::vector<Eigen::RowVector<Index, 3>> kept;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d centre = (mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) +
                                       mesh.vertices.row(mesh.faces(f, 2))) /
                                      3;
    if (!is_hole(centre)) kept.push_back(mesh.faces.row(f));
  }
  Faces faces(static_cast<Index>(kept.size()), 3);
  for (Index f = 0; f < faces.rows(); ++f) faces.row(f) = kept[f];
  return faces;
}

bool sound(const FilledMesh& mesh) {
  const MeshCheck check = check_mesh(mesh.vertices, mesh.faces);
  return check.manifold() && check.oriented();
}

TEST(HoleFilling, ClosesATorusWithTwoHoles) {
  const auto torus = shapes::torus(40, 20);
  const Faces faces = without(torus, [](const auto& p) { return std::abs(p.x()) > 1.2 && std::abs(p.y()) < 0.3; });
  const FilledMesh filled = fill_holes(torus.vertices, faces, kEverything);
  EXPECT_EQ(filled.filled, 2);
  EXPECT_EQ(filled.left, 0);
  EXPECT_TRUE(sound(filled));
  const MeshCheck check = check_mesh(filled.vertices, filled.faces);
  EXPECT_TRUE(check.closed());
  EXPECT_EQ(check.genus(), 1);
}

TEST(HoleFilling, LeavesWhatIsLargerThanTheLimit) {
  const auto grid = shapes::grid(10, 10);
  const Faces faces = without(grid, [](const auto& p) { return (p - Eigen::RowVector3d(0.5, 0.5, 0)).norm() < 0.15; });
  const FilledMesh filled = fill_holes(grid.vertices, faces, 0.6);  // the grid's own border is larger
  EXPECT_EQ(filled.filled, 1);
  EXPECT_EQ(filled.left, 1);
  EXPECT_TRUE(sound(filled));
}

TEST(HoleFilling, ALongSlitIsAsLargeAsItIsWide) {
  const auto grid = shapes::grid(20, 20);
  const Faces faces =
      without(grid, [](const auto& p) { return std::abs(p.x() - 0.5) < 0.3 && std::abs(p.y() - 0.5) < 0.06; });
  EXPECT_EQ(fill_holes(grid.vertices, faces, 0.25).filled, 1);
  EXPECT_EQ(fill_holes(grid.vertices, faces, 0.1).filled, 0);
}

TEST(HoleFilling, AnOuterBorderIsNoHole) {
  const auto grid = shapes::grid(4, 4);
  EXPECT_EQ(fill_holes(grid.vertices, grid.faces, 100).filled, 0);
  const FilledMesh closed = fill_holes(grid.vertices, grid.faces, kEverything);
  EXPECT_EQ(closed.filled, 1);
  EXPECT_TRUE(sound(closed));
}

TEST(HoleFilling, TheBorderOfAFewFacesIsNoHole) {
  const auto square = shapes::grid(2, 2);
  EXPECT_EQ(fill_holes(square.vertices, square.faces, 10).filled, 0);
  EXPECT_EQ(fill_holes(square.vertices, square.faces, std::numeric_limits<double>::infinity()).filled, 1);
}

/// A closed roof, 2 wide and 8 long, that rises at `slope` on both sides of its ridge.
shapes::Mesh roof(double slope) {
  constexpr Index kRows = 9;
  shapes::Mesh mesh{Points(3 * kRows, 3), Faces(6 * (kRows - 1) + 2, 3)};
  Index f = 0;
  for (Index row = 0; row < kRows; ++row) {
    const double y = static_cast<double>(row);
    mesh.vertices.middleRows(3 * row, 3) << -1, y, 0, 1, y, 0, 0, y, slope;
    for (Index corner = 0; row > 0 && corner < 3; ++corner) {
      const Index a = 3 * row + corner, b = 3 * row + (corner + 1) % 3;
      mesh.faces.row(f++) << a - 3, a, b;
      mesh.faces.row(f++) << a - 3, b, b - 3;
    }
  }
  mesh.faces.row(f++) << 0, 1, 2;
  mesh.faces.row(f++) << 3 * kRows - 3, 3 * kRows - 1, 3 * kRows - 2;
  return mesh;
}

TEST(HoleFilling, TheOpenSideOfAPinIsAHoleAndThatOfAFoldIsABorder) {
  const auto filled_of = [](double slope) {
    const shapes::Mesh mesh = roof(slope);
    return fill_holes(mesh.vertices, without(mesh, [](const auto& p) { return p.z() == 0; }), 100);
  };
  const FilledMesh pin = filled_of(1.2);  // sides at 50 degrees: a patch turns by 130
  EXPECT_EQ(pin.filled, 1);
  EXPECT_TRUE(sound(pin));
  EXPECT_TRUE(check_mesh(pin.vertices, pin.faces).closed());
  EXPECT_EQ(filled_of(0.3).filled, 0);  // at 17
}

/// A ring of faces around a hole whose border is so far from the middle, and so high.
shapes::Mesh ring_around(const std::vector<double>& radii, const std::vector<double>& heights) {
  const Index edges = static_cast<Index>(radii.size());
  shapes::Mesh mesh{Points(2 * edges, 3), Faces(2 * edges, 3)};
  for (Index i = 0; i < edges; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(edges);
    const Index next = (i + 1) % edges;
    mesh.vertices.row(i) << radii[i] * std::cos(angle), radii[i] * std::sin(angle), heights[i];
    mesh.vertices.row(edges + i) << 2 * std::cos(angle), 2 * std::sin(angle), 0;
    mesh.faces.row(2 * i) << i, edges + i, edges + next;
    mesh.faces.row(2 * i + 1) << i, edges + next, next;
  }
  return mesh;
}

TEST(HoleFilling, NoFaceOfASmallPatchIsTurnedOver) {
  // Of this hole the Delaunay triangulation holds only patches with a face that looks down.
  const shapes::Mesh ring =
      ring_around({0.4, 0.2, 0.9, 0.7, 1.0, 0.8, 0.4, 0.2, 0.2}, {0, 0, -0.1, -0.1, 0, 0, -0.1, 0.1, 0});
  const FilledMesh filled = fill_holes(ring.vertices, ring.faces, 3);
  ASSERT_EQ(filled.faces.rows(), ring.faces.rows() + 7);
  for (Index f = 0; f < filled.faces.rows(); ++f) {
    const auto corner = [&](int i) { return filled.vertices.row(filled.faces(f, i)); };
    EXPECT_GT(area_vector(corner(0), corner(1), corner(2)).z(), 0);
  }
}

TEST(HoleFilling, ZeroFillsNothing) {
  const auto grid = shapes::grid(3, 3);
  const FilledMesh filled = fill_holes(grid.vertices, grid.faces, 0);
  EXPECT_EQ(filled.faces, grid.faces);
  EXPECT_EQ(filled.left, 1);
}

TEST(HoleFilling, AMissingTriangleIsPutBack) {
  const auto tetrahedron = shapes::tetrahedron();
  const Faces open = tetrahedron.faces.topRows(3);
  const FilledMesh filled = fill_holes(tetrahedron.vertices, open, kEverything);
  EXPECT_EQ(filled.faces.rows(), 4);
  EXPECT_EQ(filled.vertices.rows(), 4);
  EXPECT_TRUE(sound(filled));
}

TEST(HoleFilling, TakesAFanWhereAPatchWouldUseAnEdgeTwice) {
  // Two faces of a tetrahedron: either diagonal of the hole that is left is an edge already or makes a copy.
  const auto tetrahedron = shapes::tetrahedron();
  const FilledMesh filled = fill_holes(tetrahedron.vertices, tetrahedron.faces.topRows(2), kEverything);
  EXPECT_TRUE(sound(filled));
  EXPECT_TRUE(check_mesh(filled.vertices, filled.faces).closed());
}

TEST(HoleFilling, ClosesASlitWithoutWidth) {
  // Two rows of the grid's vertices in one line: no triangle of theirs has an area, so there is no patch.
  auto grid = shapes::grid(4, 4);
  const Faces faces =
      without(grid, [](const auto& p) { return p.y() > 0.5 && p.y() < 0.75 && p.x() > 0.25 && p.x() < 0.75; });
  for (Index v = 0; v < grid.vertices.rows(); ++v) {
    if (grid.vertices(v, 1) == 0.75) grid.vertices(v, 1) = 0.5;
  }
  const FilledMesh filled = fill_holes(grid.vertices, faces, 0.5);
  EXPECT_EQ(filled.filled, 1);
  EXPECT_TRUE(sound(filled));
}

/// A ribbon along a trefoil knot: no Delaunay triangulation holds a patch of either of its borders.
shapes::Mesh knotted_ribbon(Index sections) {
  shapes::Mesh mesh{Points(2 * sections, 3), Faces(2 * sections, 3)};
  for (Index i = 0; i < sections; ++i) {
    const double t = 2 * std::numbers::pi * double(i) / double(sections);
    const Eigen::RowVector3d middle(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t),
                                    -std::sin(3 * t));
    mesh.vertices.row(2 * i) = middle;
    mesh.vertices.row(2 * i + 1) = middle + Eigen::RowVector3d(0, 0, 0.1);
    const Index next = 2 * ((i + 1) % sections);
    mesh.faces.row(2 * i) << 2 * i, next, next + 1;
    mesh.faces.row(2 * i + 1) << 2 * i, next + 1, 2 * i + 1;
  }
  return mesh;
}

TEST(HoleFilling, DoesNotSearchAllPatchesOfALongLoop) {
  const shapes::Mesh ribbon = knotted_ribbon(600);  // the search would find a patch, and for more sections take minutes
  EXPECT_EQ(fill_holes(ribbon.vertices, ribbon.faces, 100).filled, 0);
  const FilledMesh closed = fill_holes(ribbon.vertices, ribbon.faces, kEverything);
  EXPECT_TRUE(sound(closed));
  EXPECT_EQ(closed.left, 0);
}

TEST(HoleFilling, ClosesASingleTriangleWithoutItsTwin) {
  const auto tetrahedron = shapes::tetrahedron();
  const FilledMesh closed = fill_holes(tetrahedron.vertices, tetrahedron.faces.topRows(1), kEverything);
  const MeshCheck check = check_mesh(closed.vertices, closed.faces);
  EXPECT_TRUE(sound(closed));
  EXPECT_EQ(check.duplicate_faces, 0);
  EXPECT_EQ(check.boundary_edges, 0);
}

TEST(HoleFilling, RefusesAMeshThatIsNotManifold) {
  const auto tetrahedron = shapes::tetrahedron();
  Faces twice(5, 3);
  twice << tetrahedron.faces, tetrahedron.faces.row(0);
  EXPECT_THROW(fill_holes(tetrahedron.vertices, twice, 1), InvalidArgument);
  EXPECT_THROW(fill_holes(tetrahedron.vertices, tetrahedron.faces, -1), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
