// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/manifold_extraction.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/incremental_manifold.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

ExtractedMesh mesh_of(const clouds::Cloud& cloud, double radius, const ExtractionOptions& options = {}) {
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(cloud.points.rows(), radius);
  const Candidates candidates = restricted_voronoi_candidates(cloud.points, tangent_bases_across(cloud.normals),
                                                              nearest_neighbors(cloud.points, 40), radii);
  return extract_manifold(cloud.points, cloud.normals, radii, candidates, options);
}

MeshCheck check_of(const ExtractedMesh& mesh, const clouds::Cloud& cloud) {
  Points vertices(mesh.sources.size(), 3);
  for (Index v = 0; v < vertices.rows(); ++v) vertices.row(v) = cloud.points.row(mesh.sources(v));
  return check_mesh(vertices, mesh.faces);
}

TEST(ManifoldExtraction, MakesASphereClosedAndFacingOut) {
  const auto sphere = clouds::sphere(1000);
  const ExtractedMesh mesh = mesh_of(sphere, 0.3);
  const MeshCheck check = check_of(mesh, sphere);
  EXPECT_TRUE(check.manifold() && check.oriented() && check.closed());
  EXPECT_EQ(check.euler_characteristic, 2);
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d a = sphere.points.row(mesh.faces(f, 0)), b = sphere.points.row(mesh.faces(f, 1)),
                             c = sphere.points.row(mesh.faces(f, 2));
    EXPECT_GT((b - a).cross(c - a).dot(a + b + c), 0);
  }
}

TEST(ManifoldExtraction, KeepsTheBordersOfACylinderOpen) {
  const auto cylinder = clouds::cylinder(2000, 0.5, 2);
  const MeshCheck check = check_of(mesh_of(cylinder, 0.12), cylinder);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.components, 1);
  EXPECT_EQ(check.euler_characteristic, 0);
}

TEST(ManifoldExtraction, TwoSheetsStayTwo) {
  const auto sheets = clouds::joined(clouds::plane(1000), clouds::plane(1000, 0.1));
  EXPECT_EQ(check_of(mesh_of(sheets, 0.06), sheets).components, 2);
}

TEST(ManifoldExtraction, DoesNotDependOnTheSignsOfTheNormals) {
  auto sphere = clouds::sphere(800);
  const Faces faces = mesh_of(sphere, 0.3).faces;
  for (Index i = 0; i < 400; i += 3) sphere.normals.row(i) *= -1;  // fewer than half
  EXPECT_EQ(mesh_of(sphere, 0.3).faces, faces);
}

TEST(ManifoldExtraction, DropsSmallPiecesButNotTheLargestAndSaysSo) {
  auto small = clouds::sphere(100);
  small.points.rowwise() += Eigen::RowVector3d(5, 0, 0);
  ExtractionOptions options;
  options.min_component_faces = 1'000'000;
  const ExtractedMesh mesh = mesh_of(clouds::joined(clouds::sphere(500), small), 0.4, options);
  EXPECT_EQ(mesh.faces.rows(), 2 * 500 - 4);
  EXPECT_LT(mesh.sources.maxCoeff(), 500);
  EXPECT_EQ(mesh.counts.dropped_components, 1);
}

TEST(ManifoldExtraction, StricterLimitsKeepFewerFaces) {
  const auto sphere = clouds::sphere(500);
  ExtractionOptions strict;
  strict.max_circumradius = 0.07 / 0.4;
  const ExtractedMesh all = mesh_of(sphere, 0.4), small = mesh_of(sphere, 0.4, strict);
  EXPECT_LT(small.faces.rows(), all.faces.rows());
  EXPECT_GT(small.counts.refused_size, 0);
}

/// What is made of triangles of a flat zigzag strip, 0 2 4 on one side and 1 3 5 on the other.
ExtractedMesh mesh_of_strip(const std::vector<std::pair<Triangle, int>>& triangles_and_counts,
                            const ExtractionOptions& options = {}) {
  Points points(6, 3);
  for (Index i = 0; i < 6; ++i) points.row(i) << 0.5 * static_cast<double>(i), i % 2 == 0 ? 0 : 0.9, 0;
  const Index count = static_cast<Index>(triangles_and_counts.size());
  Candidates candidates{Faces(count, 3), Eigen::VectorXi(count), {}};
  for (Index t = 0; t < count; ++t) {
    const auto& [triangle, cells] = triangles_and_counts[t];
    candidates.triangles.row(t) << triangle[0], triangle[1], triangle[2];
    candidates.counts(t) = cells;
  }
  return extract_manifold(points, Eigen::RowVector3d::UnitZ().replicate(6, 1), Eigen::VectorXd::Ones(6), candidates,
                          options);
}

TEST(ManifoldExtraction, ABridgeJoinsTwoPieces) {
  const ExtractedMesh mesh = mesh_of_strip({{{0, 1, 2}, 3}, {{1, 2, 3}, 1}, {{2, 3, 4}, 1}, {{3, 4, 5}, 3}});
  EXPECT_EQ(mesh.faces.rows(), 4);
  EXPECT_EQ(mesh.sources.size(), 6);  // nothing is pinched: they share edges
}

TEST(ManifoldExtraction, NoBridgeJoinsTwoLargePieces) {
  ExtractionOptions options;
  options.max_bridged_faces = 0;
  options.min_component_faces = 1;
  const ExtractedMesh mesh = mesh_of_strip({{{0, 1, 2}, 3}, {{1, 2, 3}, 1}, {{3, 4, 5}, 3}}, options);
  EXPECT_EQ(mesh.counts.refused_loose, 1);
}

TEST(ManifoldExtraction, NoBridgeJoinsAPieceToItself) {
  const ExtractedMesh mesh = mesh_of_strip({{{0, 1, 2}, 3}, {{1, 2, 3}, 3}, {{2, 3, 4}, 3}, {{0, 1, 4}, 1}});
  EXPECT_EQ(mesh.counts.refused_loose, 1);
  EXPECT_EQ(mesh.faces.rows(), 3);
}

/// What is made of a flat strip of which so many points at one end face down.
ExtractedMesh mesh_of_turned_strip(Index max_bridged_faces, Index turned = 20) {
  const Index count = 40;
  Points points(count, 3), normals = Eigen::RowVector3d::UnitZ().replicate(count, 1);
  for (Index i = 0; i < count; ++i) points.row(i) << 0.5 * static_cast<double>(i), i % 2 == 0 ? 0 : 0.9, 0;
  normals.bottomRows(turned) *= -1;
  Candidates candidates{Faces(count - 2, 3), Eigen::VectorXi::Constant(count - 2, 3), {}};
  for (Index t = 0; t < count - 2; ++t) candidates.triangles.row(t) << t, t + 1, t + 2;
  ExtractionOptions options;
  options.max_bridged_faces = max_bridged_faces;
  return extract_manifold(points, normals, Eigen::VectorXd::Ones(count), candidates, options);
}

TEST(ManifoldExtraction, LargePiecesThatFaceOppositeWaysAreNotJoined) {
  const ExtractedMesh apart = mesh_of_turned_strip(10);
  EXPECT_EQ(apart.counts.refused_sides, 1);
  EXPECT_EQ(apart.faces.rows(), 37);
}

TEST(ManifoldExtraction, SmallPiecesAreJoinedWhateverTheirNormalsSay) {
  const ExtractedMesh joined = mesh_of_turned_strip(20, 6);
  EXPECT_EQ(joined.counts.refused_sides, 0);
  EXPECT_EQ(joined.counts.turned_patches, 0);
  EXPECT_EQ(joined.faces.rows(), 38);
}

TEST(ManifoldExtraction, ALargerPartThatHangsByOneEdgeIsTurned) {
  const ExtractedMesh cut = mesh_of_turned_strip(20);
  EXPECT_EQ(cut.counts.refused_sides, 0);
  EXPECT_EQ(cut.counts.turned_patches, 1);
  EXPECT_EQ(cut.faces.rows(), 37);
}

TEST(ManifoldExtraction, AStrayPointWithAWideDiskDrawsNoSpike) {
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, 20, 0;
  Candidates candidates{Faces(2, 3), Eigen::Vector2i(3, 3), {}};
  candidates.triangles << 0, 1, 2, 1, 2, 3;
  const Eigen::Vector4d disk_radii(1, 1, 1, 50);
  const ExtractedMesh mesh =
      extract_manifold(points, Eigen::RowVector3d::UnitZ().replicate(4, 1), disk_radii, candidates, {});
  EXPECT_EQ(mesh.counts.refused_size, 1);
  EXPECT_EQ(mesh.faces.rows(), 1);
}

TEST(ManifoldExtraction, AccountsForEveryCandidate) {
  const ExtractionCounts c = mesh_of(clouds::cylinder(2000, 0.5, 2), 0.12).counts;
  EXPECT_EQ(c.t3 + c.t12, c.t3_kept + c.t12_kept + c.refused_edge + c.refused_link + c.refused_orientation +
                              c.refused_fold + c.refused_normal + c.refused_size + c.refused_sides + c.refused_loose);
}

TEST(ManifoldExtraction, RefusesCandidatesThatCannotBe) {
  const auto sphere = clouds::sphere(10);
  const Eigen::VectorXd radii = Eigen::VectorXd::Ones(10);
  const auto extract = [&](Index a, Index b, Index c, int count) {
    Candidates candidates{Faces(1, 3), Eigen::VectorXi::Constant(1, count), Eigen::VectorXd::Ones(10)};
    candidates.triangles << a, b, c;
    extract_manifold(sphere.points, sphere.normals, radii, candidates, {});
  };
  EXPECT_NO_THROW(extract(7, 8, 9, 3));
  EXPECT_THROW(extract(7, 8, 10, 3), InvalidArgument);
  EXPECT_THROW(extract(7, 8, Index{1} << 40, 3), InvalidArgument);
  EXPECT_THROW(extract(-1, 8, 9, 3), InvalidArgument);
  EXPECT_THROW(extract(8, 7, 9, 3), InvalidArgument) << "not ascending";
  EXPECT_THROW(extract(7, 7, 9, 3), InvalidArgument) << "a corner twice";
  EXPECT_THROW(extract(7, 8, 9, 0), InvalidArgument);
  EXPECT_THROW(extract(7, 8, 9, 4), InvalidArgument);
}

TEST(ManifoldExtraction, RefusesRowsThatDoNotMatch) {
  const auto sphere = clouds::sphere(10);
  const Eigen::VectorXd radii = Eigen::VectorXd::Ones(10);
  const Candidates none{Faces(0, 3), Eigen::VectorXi(0), Eigen::VectorXd::Ones(10)},
      uncounted{Faces(0, 3), Eigen::VectorXi(1), {}};
  EXPECT_EQ(extract_manifold(sphere.points, sphere.normals, radii, none, {}).faces.rows(), 0);
  EXPECT_THROW(extract_manifold(sphere.points, sphere.normals, radii, uncounted, {}), InvalidArgument);
  EXPECT_THROW(extract_manifold(sphere.points.topRows(9), sphere.normals, radii, none, {}), InvalidArgument);
  EXPECT_THROW(extract_manifold(sphere.points.leftCols(2), sphere.normals, radii, none, {}), InvalidArgument);
  EXPECT_THROW(extract_manifold(sphere.points, sphere.normals, radii.head(9), none, {}), InvalidArgument);
  EXPECT_THROW(extract_manifold(sphere.points, sphere.normals, -radii, none, {}), InvalidArgument);
}

TEST(ManifoldExtraction, RefusesLimitsThatAreNone) {
  ExtractionOptions options;
  options.max_fold = 0;
  EXPECT_THROW(mesh_of(clouds::sphere(100), 0.5, options), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
