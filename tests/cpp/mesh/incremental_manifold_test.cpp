// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/incremental_manifold.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/mesh/pinched_vertices.hpp"

namespace hdpea {
namespace {

using Verdict = IncrementalManifold::Verdict;

/// A mesh of triangles that must all fit.
IncrementalManifold built(Index vertices, const std::vector<Triangle>& triangles) {
  IncrementalManifold mesh(vertices);
  for (const Triangle& triangle : triangles) {
    EXPECT_EQ(mesh.check(triangle), Verdict::fits);
    mesh.insert(triangle);
  }
  return mesh;
}

TEST(IncrementalManifold, TakesATetrahedronWholeAndNothingMore) {
  auto mesh = built(5, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(mesh.check({0, 1, 4}), Verdict::crowded_edge);
}

TEST(IncrementalManifold, RefusesAThirdFaceAtAnEdge) {
  auto mesh = built(5, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(mesh.check({0, 1, 4}), Verdict::crowded_edge);
}

TEST(IncrementalManifold, RefusesAFaceAtAClosedFan) {
  // Vertex 0 is surrounded by 1, 2, 3; a further face there would not share an edge.
  auto mesh = built(6, {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}});
  EXPECT_EQ(mesh.check({0, 4, 5}), Verdict::broken_link);
}

TEST(IncrementalManifold, RefusesToCloseAPartOfAFan) {
  // Vertex 0 has the fan 1-2-3 and, apart from it, the face 4-5; closing 1-3 would leave 4-5 out.
  auto mesh = built(6, {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}});
  EXPECT_EQ(mesh.check({0, 1, 3}), Verdict::broken_link);
  EXPECT_EQ(mesh.check({0, 3, 4}), Verdict::fits);
}

TEST(IncrementalManifold, RefusesTheLastFaceOfAMoebiusStrip) {
  auto mesh = built(5, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {0, 3, 4}});
  EXPECT_EQ(mesh.check({0, 1, 4}), Verdict::not_orientable);
}

TEST(IncrementalManifold, AgreesOnOneOrientationWherePiecesMeet) {
  // Two pieces grown apart and joined last: across every edge the faces run in opposite directions.
  auto mesh = built(6, {{0, 1, 2}, {3, 4, 5}, {1, 2, 3}, {2, 3, 4}});
  for (Index f = 1; f < 4; ++f) EXPECT_EQ(mesh.piece_of(f).first, mesh.piece_of(0).first);
  const auto& triangles = mesh.triangles();
  const bool opposite = IncrementalManifold::opposite_parity(triangles[0], triangles[2], 1, 2);
  EXPECT_EQ(mesh.piece_of(0).second != mesh.piece_of(2).second, opposite);
}

TEST(SplitPinchedVertices, GivesEachFanItsOwnVertex) {
  Faces faces;
  Eigen::Vector<Index, Eigen::Dynamic> sources;
  EXPECT_EQ(split_pinched_vertices({{0, 1, 2}, {0, 2, 3}, {0, 4, 5}}, 7, faces, sources), 1);
  EXPECT_EQ(sources.size(), 7);  // six used, one of them twice; vertex 6 is left out
  EXPECT_EQ(sources(faces(2, 0)), 0);
  EXPECT_NE(faces(2, 0), faces(0, 0));
  EXPECT_EQ(faces(0, 0), faces(1, 0));
}

}  // namespace
}  // namespace hdpea
