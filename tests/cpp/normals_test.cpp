// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/normals.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"
#include "hdpea_cpp/errors.hpp"
#include "hdpea_cpp/neighbors.hpp"

namespace hdpea {
namespace {

Points with_random_signs(Points normals) {
  for (Index i = 0; i < normals.rows(); ++i) {
    if (clouds::weyl(i * i).x() < 0.5) normals.row(i) *= -1;
  }
  return normals;
}

/// Share of the points whose normal faces the way the true one does.
double share_right(const Points& normals, const Points& truth) {
  return ((normals.array() * truth.array()).rowwise().sum() > 0).cast<double>().mean();
}

class Orientation : public testing::TestWithParam<clouds::Cloud> {};

TEST_P(Orientation, IsFoundWhateverTheSigns) {
  const auto& [points, normals] = GetParam();
  const Neighbors neighbors = nearest_neighbors(points, 16);
  const Points oriented = orient_normals(points, with_random_signs(normals), neighbors);
  EXPECT_EQ(share_right(oriented, normals), 1);
  EXPECT_EQ(oriented, orient_normals(points, normals, neighbors));
}

TEST_P(Orientation, IsSeenToBeConsistentOrNot) {
  const auto& [points, normals] = GetParam();
  const Neighbors neighbors = nearest_neighbors(points, 16);
  EXPECT_GT(orientation_consistency(points, normals, neighbors), 0.99);
  EXPECT_NEAR(orientation_consistency(points, with_random_signs(normals), neighbors), 0.5, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Orientation,
                         testing::Values(clouds::sphere(2000), clouds::cube(900), clouds::thin_plate()));

TEST(Normals, OfASphereAreEstimatedWell) {
  const auto sphere = clouds::sphere(4000);
  const Points normals = estimate_normals(sphere.points, nearest_neighbors(sphere.points, 16));
  EXPECT_GT((normals.array() * sphere.normals.array()).rowwise().sum().abs().minCoeff(), 0.999);
}

TEST(Normals, OfAPlaneAreExact) {
  const auto plane = clouds::plane(1000);
  const Points normals = estimate_normals(plane.points, nearest_neighbors(plane.points, 16));
  EXPECT_LT((normals.col(2).cwiseAbs().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(Normals, AwayFromItsEdgesACubeHasThoseOfItsFaces) {
  const auto box = clouds::cube(900);
  const Points normals = estimate_normals(box.points, nearest_neighbors(box.points, 16));
  for (Index i = 0; i < normals.rows(); ++i) {
    const Eigen::RowVector3d from_middle = (box.points.row(i).array() - 0.5).abs();
    const bool inside = (from_middle.array() < 0.4).count() == 2;  // of a face, a few spacings from its edges
    if (inside) {
      EXPECT_GT(std::abs(normals.row(i).dot(box.normals.row(i))), 1 - 1e-9);
    }
  }
}

TEST(Normals, ALonelyPointGetsAUnitVector) {
  const Points point = Points::Zero(1, 3);
  EXPECT_NEAR(estimate_normals(point, Neighbors::Constant(1, 4, -1)).norm(), 1, 1e-12);
}

TEST(Normals, RefuseArraysOfDifferentLengths) {
  const auto sphere = clouds::sphere(50);
  const Neighbors neighbors = nearest_neighbors(sphere.points, 4);
  EXPECT_THROW(estimate_normals(sphere.points, neighbors.topRows(3)), InvalidArgument);
  EXPECT_THROW(orient_normals(sphere.points, sphere.normals.topRows(3), neighbors), InvalidArgument);
  EXPECT_THROW(orientation_consistency(sphere.points, sphere.normals, neighbors.topRows(3)), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
