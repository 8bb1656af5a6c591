// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/piece_sides.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "hdpea_cpp/base/errors.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

/// Tetrahedra of the given sizes about one place, each facing out or not.
TriangleMesh nested(const std::vector<std::pair<double, bool>>& sizes_and_out) {
  const Index count = static_cast<Index>(sizes_and_out.size());
  TriangleMesh mesh{Points(4 * count, 3), Faces(4 * count, 3)};
  for (Index k = 0; k < count; ++k) {
    const auto& [size, out] = sizes_and_out[k];
    mesh.vertices.middleRows(4 * k, 4) << 1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1;
    mesh.vertices.middleRows(4 * k, 4) *= size;
    auto faces = mesh.faces.middleRows(4 * k, 4);
    faces << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    if (!out) faces.col(1).swap(faces.col(2));
    faces.array() += 4 * k;
  }
  return mesh;
}

TEST(PieceSides, OnlyTheOutermostPieceIsTurned) {
  for (const bool outer : {false, true}) {
    for (const bool inner : {false, true}) {
      const TriangleMesh given = nested({{1, outer}, {0.1, inner}});
      const FacedMesh faced = face_outwards(given.vertices, given.faces);
      const bool agree = nested({{1, true}, {0.1, inner}}).faces == faced.faces;
      EXPECT_NE(agree, nested({{1, false}, {0.1, inner}}).faces == faced.faces);
      EXPECT_EQ(faced.faces.bottomRows(4), given.faces.bottomRows(4));
      EXPECT_LE(faced.turned, 1);
      EXPECT_EQ(faced.within, !inner);
      EXPECT_EQ(faced.sideless, 0);
    }
  }
  const TriangleMesh out = nested({{1, true}}), in = nested({{1, false}});
  EXPECT_EQ(face_outwards(out.vertices, out.faces).faces, face_outwards(in.vertices, in.faces).faces);
}

TEST(PieceSides, WhatIsOpenIsKept) {
  const TriangleMesh given = nested({{1, false}});
  const Faces two = given.faces.topRows(2), flipped = nested({{1, true}}).faces.topRows(2);
  for (const Faces& faces : {two, flipped}) {
    const FacedMesh faced = face_outwards(given.vertices, faces);
    EXPECT_EQ(faced.faces, faces);
    EXPECT_EQ(faced.sideless, 1);
  }
}

/// Flat squares at the given heights, each facing up or down.
TriangleMesh squares(const std::vector<std::pair<double, bool>>& heights_and_up) {
  const shapes::Mesh grid = shapes::grid(4, 4);
  const Index vertices = grid.vertices.rows(), faces = grid.faces.rows();
  const Index count = static_cast<Index>(heights_and_up.size());
  TriangleMesh mesh{grid.vertices.replicate(count, 1), grid.faces.replicate(count, 1)};
  for (Index k = 0; k < count; ++k) {
    const auto& [height, up] = heights_and_up[k];
    mesh.vertices.middleRows(k * vertices, vertices).col(2).array() += height;
    auto own = mesh.faces.middleRows(k * faces, faces);
    own.array() += k * vertices;
    if (!up) own.col(1).swap(own.col(2));
  }
  return mesh;
}

TEST(PieceSides, WhatLiesFlatFacesUp) {
  const TriangleMesh up = squares({{0, true}, {3, true}}), down = squares({{0, false}, {3, false}});
  EXPECT_EQ(face_outwards(down.vertices, down.faces).faces, up.faces);
  EXPECT_EQ(face_outwards(up.vertices, up.faces).faces, up.faces);
}

TEST(PieceSides, OfAPlatesTwoSidesOneFacesDown) {
  const TriangleMesh plate = squares({{0, false}, {0.1, true}});
  EXPECT_EQ(face_outwards(plate.vertices, plate.faces).faces, plate.faces);
}

TEST(PieceSides, InAnOpenBowlAClosedPieceIsTurned) {
  for (const bool out : {false, true}) {
    const Faces given = nested({{1, false}, {0.1, out}}).faces.bottomRows(7);  // the bowl lacks one of its four faces
    const TriangleMesh sought = nested({{1, false}, {0.1, true}});
    const FacedMesh faced = face_outwards(sought.vertices, given);
    EXPECT_EQ(faced.faces, sought.faces.bottomRows(7));
    EXPECT_EQ(faced.turned, out ? 0 : 1);
  }
}

/// A ball that faces in and lacks its south pole, around a tetrahedron that does, too.
TriangleMesh in_a_ball_with_a_hole(Index rings) {
  const shapes::Mesh ball = shapes::without_vertices(shapes::sphere(rings, 24), {0});
  const TriangleMesh inner = nested({{0.1, false}});
  TriangleMesh both{Points(ball.vertices.rows() + 4, 3), Faces(ball.faces.rows() + 4, 3)};
  both.vertices << ball.vertices, inner.vertices;
  both.faces << ball.faces.rowwise().reverse(), (inner.faces.array() + ball.vertices.rows()).matrix();
  return both;
}

TEST(PieceSides, AWallOfACavityIsKeptWhereTheBallAroundItHasASmallGap) {
  for (const auto& [rings, turned] : {std::pair<Index, Index>{24, 0}, {18, 1}}) {  // holes of radius 0.13 and 0.16
    const TriangleMesh given = in_a_ball_with_a_hole(rings);
    const FacedMesh faced = face_outwards(given.vertices, given.faces);
    EXPECT_EQ(faced.turned, turned);
    EXPECT_EQ(faced.faces == given.faces, turned == 0);
    EXPECT_EQ(faced.sideless, 0);
  }
}

TEST(PieceSides, RefusesVerticesThatDoNotExist) {
  const TriangleMesh given = nested({{1, true}});
  EXPECT_THROW(face_outwards(given.vertices.topRows(3), given.faces), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
