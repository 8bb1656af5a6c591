// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/gap_closing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

constexpr Index kAround = 30, kAcross = 15;

/// Of a torus made by shapes::torus.
Points outward(const Points& vertices) {
  Points normals(vertices.rows(), 3);
  for (Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::RowVector3d centre(vertices(v, 0), vertices(v, 1), 0);
    normals.row(v) = (vertices.row(v) - centre.normalized()).normalized();
  }
  return normals;
}

/// Without every face that has a corner for which this holds.
template <class IsGone>
Faces without(const shapes::Mesh& mesh, IsGone is_gone) {
  std::vector<Index> kept;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    bool gone = false;
    for (const Index v : mesh.faces.row(f)) gone = gone || is_gone(v / kAcross, v % kAcross);
    if (!gone) kept.push_back(f);
  }
  return mesh.faces(kept, Eigen::all);
}

MeshCheck check(const FilledMesh& mesh) { return check_mesh(mesh.vertices, mesh.faces); }

TEST(GapClosing, ClosesTheGapBetweenTwoLoopsThatRunAlongEachOther) {
  const shapes::Mesh torus = shapes::torus(kAround, kAcross);
  const Faces cut = without(torus, [](Index around, Index) { return around == 7; });
  ASSERT_EQ(check_mesh(torus.vertices, cut).boundary_loops, 2);
  const FilledMesh closed = close_gaps(torus.vertices, cut, outward(torus.vertices), 1.2);
  EXPECT_EQ(closed.filled, 2);
  EXPECT_EQ(closed.left, 0);
  const MeshCheck found = check(closed);
  EXPECT_TRUE(found.manifold() && found.oriented() && found.closed());
  EXPECT_EQ(found.genus(), 1);  // a lid on each loop would have made it a sphere
  EXPECT_EQ(closed.faces.topRows(cut.rows()), cut);
}

TEST(GapClosing, ClosesALoopThatWindsAroundTheSurface) {
  const shapes::Mesh torus = shapes::torus(kAround, kAcross);
  const Faces cut = without(torus, [](Index around, Index across) { return around == 7 && across / 2 != 2; });
  ASSERT_EQ(check_mesh(torus.vertices, cut).boundary_loops, 1);
  const FilledMesh closed = close_gaps(torus.vertices, cut, outward(torus.vertices), 1.2);
  EXPECT_EQ(closed.filled, 1);
  const MeshCheck found = check(closed);
  EXPECT_TRUE(found.manifold() && found.oriented() && found.closed());
  EXPECT_EQ(found.genus(), 1);
}

TEST(GapClosing, ClosesTheGapBetweenTwoLoopsThatMeetInOnePlace) {
  shapes::Mesh torus = shapes::torus(kAround, kAcross);
  const Index inner = kAcross / 2;  // where the loops are nearest, as a pinched vertex that was split
  torus.vertices.row(8 * kAcross + inner) = torus.vertices.row(6 * kAcross + inner);
  const Faces cut = without(torus, [](Index around, Index) { return around == 7; });
  const FilledMesh closed = close_gaps(torus.vertices, cut, outward(torus.vertices), 0.8);
  EXPECT_EQ(closed.left, 0);
  EXPECT_TRUE(check(closed).manifold() && check(closed).closed());
}

TEST(GapClosing, LeavesWhatIsLargerOpen) {
  const shapes::Mesh torus = shapes::torus(kAround, kAcross);
  const Faces cut = without(torus, [](Index around, Index) { return around == 7; });
  const FilledMesh same = close_gaps(torus.vertices, cut, outward(torus.vertices), 0.2);
  EXPECT_EQ(same.faces, cut);
  EXPECT_EQ(same.left, 2);
}

TEST(GapClosing, DoesNotFoldBackOverANarrowBandOrASmallSheet) {
  const shapes::Mesh torus = shapes::torus(kAround, kAcross);
  const Faces band = without(torus, [](Index around, Index) { return around > 1; });
  ASSERT_EQ(check_mesh(torus.vertices, band).boundary_loops, 2);
  EXPECT_EQ(close_gaps(torus.vertices, band, outward(torus.vertices), 1).faces, band);

  const shapes::Mesh sheet = shapes::grid(4, 4);
  Points up = Points::Zero(sheet.vertices.rows(), 3);
  up.col(2).setOnes();
  EXPECT_EQ(close_gaps(sheet.vertices, sheet.faces, up, 2).faces, sheet.faces);
}

TEST(GapClosing, RefusesWhatBreaksTheContract) {
  const shapes::Mesh grid = shapes::grid(2, 2);
  const Points normals = Points::Zero(grid.vertices.rows(), 3);
  EXPECT_THROW(close_gaps(grid.vertices, grid.faces, normals, -1), InvalidArgument);
  EXPECT_THROW(close_gaps(grid.vertices, grid.faces, normals.topRows(2), 1), InvalidArgument);
  Faces twice(grid.faces.rows() + 1, 3);
  twice << grid.faces, grid.faces.row(0);
  EXPECT_THROW(close_gaps(grid.vertices, twice, normals, 1), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
