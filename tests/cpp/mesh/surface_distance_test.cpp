// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/surface_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

using shapes::Mesh;

Points random_points(Index n, double size) {
  std::mt19937_64 random(3);
  Points points(n, 3);
  for (double& x : points.reshaped()) x = size * (static_cast<double>(random() % 2001) / 1000 - 1);
  return points;
}

SurfacePoints closest(const Mesh& mesh, const Points& queries) {
  return closest_surface_points(mesh.vertices, mesh.faces, queries);
}

/// The least distance over each face alone, and the lowest face that has it but for rounding.
void expect_closest_of_all_faces(const Mesh& mesh, const Points& queries) {
  const SurfacePoints found = closest(mesh, queries);
  Eigen::VectorXd least = Eigen::VectorXd::Constant(queries.rows(), std::numeric_limits<double>::infinity());
  Eigen::Vector<Index, Eigen::Dynamic> face(queries.rows());
  constexpr double rounding = 1e-14;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const SurfacePoints alone = closest({mesh.vertices, mesh.faces.row(f)}, queries);
    for (Index i = 0; i < queries.rows(); ++i) {
      if (alone.distance(i) < least(i) - rounding) face(i) = f;
      least(i) = std::min(alone.distance(i), least(i));
    }
  }
  EXPECT_LT((found.distance - least).cwiseAbs().maxCoeff(), rounding);
  EXPECT_EQ(found.face, face);
}

TEST(SurfaceDistance, OfAGridIsTheHeight) {
  Points queries(3, 3);
  queries << .3, .6, .25, .5, .5, -2, 2, .5, 0;
  const SurfacePoints found = closest(shapes::grid(4, 4), queries);
  EXPECT_TRUE(found.distance.isApprox(Eigen::Vector3d(.25, 2, 1)));
  EXPECT_TRUE(found.position.row(2).isApprox(Eigen::RowVector3d(1, .5, 0)));
}

TEST(SurfaceDistance, IsTheLeastOverAllFaces) {
  expect_closest_of_all_faces(shapes::torus(9, 7), random_points(300, 1.5));
}

TEST(SurfaceDistance, TiesGoToTheLowestFace) {
  const Mesh grid = shapes::grid(3, 3);
  expect_closest_of_all_faces(grid, grid.vertices);
}

TEST(SurfaceDistance, BarycentricWeightsGiveThePosition) {
  const Mesh mesh = shapes::sphere(6, 9);
  const SurfacePoints found = closest(mesh, random_points(200, 2));
  EXPECT_GE(found.barycentric.minCoeff(), 0);
  for (Index i = 0; i < 200; ++i) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (Index c = 0; c < 3; ++c) sum += found.barycentric(i, c) * mesh.vertices.row(mesh.faces(found.face(i), c));
    EXPECT_NEAR((sum - found.position.row(i)).norm(), 0, 1e-14);
    EXPECT_NEAR(found.barycentric.row(i).sum(), 1, 1e-14);
  }
}

TEST(SurfaceDistance, CopesWithFacesWithoutArea) {
  const Mesh mesh = shapes::make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 0, 3}, {0, 3, 1}});
  Points queries(2, 3);
  queries << 1.5, 3, 4, -1, 0, 0;
  const SurfacePoints found = closest(mesh, queries);
  EXPECT_DOUBLE_EQ(found.distance(0), 5);
  EXPECT_DOUBLE_EQ(found.distance(1), 1);
}

TEST(SurfaceDistance, DoesNotDependOnThreads) {
  const Mesh mesh = shapes::torus(30, 20);
  const Points queries = random_points(3000, 1.5);
  const SurfacePoints many = closest(mesh, queries);
  set_thread_limit(1);
  const SurfacePoints one = closest(mesh, queries);
  set_thread_limit(0);
  EXPECT_EQ(many.distance, one.distance);
  EXPECT_EQ(many.face, one.face);
}

TEST(SurfaceDistance, FindsTheSameFacesInOtherUnits) {
  Mesh mesh = shapes::torus(30, 20);
  Points queries = random_points(3000, 1.5);
  const SurfacePoints found = closest(mesh, queries);
  mesh.vertices *= 1000;
  queries *= 1000;
  EXPECT_EQ(closest(mesh, queries).face, found.face);
}

TEST(SurfaceDistance, RefusesABadContract) {
  const Mesh mesh = shapes::tetrahedron();
  EXPECT_THROW(closest({mesh.vertices, Faces(0, 3)}, mesh.vertices), InvalidArgument);
  EXPECT_THROW(closest({mesh.vertices, Faces::Constant(1, 3, 4)}, mesh.vertices), InvalidArgument);
  EXPECT_THROW(closest(mesh, Points::Constant(1, 3, std::numeric_limits<double>::infinity())), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
