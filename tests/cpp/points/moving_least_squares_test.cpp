// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/moving_least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/normals.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

SurfacePlaces denoised(const clouds::Cloud& cloud, Index neighbors = 40) {
  return moving_least_squares(cloud.points, cloud.normals, cloud.points, nearest_neighbors(cloud.points, neighbors));
}

double largest(const Eigen::MatrixXd& difference) { return difference.array().abs().maxCoeff(); }

TEST(MovingLeastSquares, LeaveAPlaneWhereItIs) {
  const auto plane = clouds::plane(500);
  const SurfacePlaces moved = denoised(plane);
  EXPECT_LT(largest(moved.points - plane.points), 1e-12);
  EXPECT_LT(largest(moved.normals - plane.normals), 1e-12);
}

TEST(MovingLeastSquares, ReproduceAParaboloidSeenFromAbove) {
  clouds::Cloud bowl = clouds::plane(500);
  bowl.points.col(2) = 0.3 * bowl.points.col(0).array().square() + bowl.points.col(1).array().square();
  EXPECT_LT(largest(denoised(bowl).points - bowl.points), 1e-6);
}

TEST(MovingLeastSquares, HalveTheNoiseOfASphereAndTurnItsNormals) {
  clouds::Cloud sphere = clouds::sphere(2000);
  const Points true_normals = sphere.normals;
  for (Index i = 0; i < sphere.points.rows(); ++i) sphere.points.row(i) *= 1 + 0.02 * std::sin(100.0 * double(i * i));
  const auto error = [](const Points& points) { return (points.rowwise().norm().array() - 1).square().mean(); };
  const SurfacePlaces moved = denoised(sphere);
  EXPECT_LT(error(moved.points), 0.25 * error(sphere.points));
  EXPECT_GT((moved.normals.array() * true_normals.array()).rowwise().sum().minCoeff(), 0.98);
}

TEST(MovingLeastSquares, KeepTheEdgesOfACube) {
  const auto cube = clouds::cube(400);
  EXPECT_LT(largest(denoised(cube).points - cube.points), 2e-3);  // a twentieth of the spacing
}

TEST(MovingLeastSquares, LeaveAPointWithoutNeighborsAlone) {
  const auto sphere = clouds::sphere(10);
  const SurfacePlaces moved =
      moving_least_squares(sphere.points, sphere.normals, sphere.points, Neighbors::Constant(10, 5, -1));
  EXPECT_EQ(largest(moved.points - sphere.points), 0);
  EXPECT_EQ(largest(moved.normals - sphere.normals), 0);
}

TEST(MovingLeastSquares, NeverMoveAPointBeyondItsNeighbors) {
  // Heaps of points a millionth wide: between them a quadric may pass anywhere.
  Points points = 1e-6 * Points::Random(400, 3);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) += Eigen::RowVector3d(i % 2, i / 2 % 2, i / 4 % 2);
  const Neighbors neighbors = nearest_neighbors(points, 80);
  const SurfacePlaces moved = moving_least_squares(points, estimate_normals(points, neighbors), points, neighbors);
  const double reach = (points.row(neighbors(0, 79)) - points.row(0)).norm();
  EXPECT_LE((moved.points - points).rowwise().norm().maxCoeff(), 2 * reach);
}

TEST(MovingLeastSquares, RaisePointsThatLieABitInsideASphere) {
  // Every neighbour of such a point lies below its tangent plane: the surface is higher than all of them.
  clouds::Cloud sphere = clouds::sphere(2000);
  for (Index i = 0; i < sphere.points.rows(); i += 20) sphere.points.row(i) *= 1 - 1e-4;
  const SurfacePlaces moved = denoised(sphere);
  for (Index i = 0; i < sphere.points.rows(); i += 20) {
    EXPECT_LT(std::abs(moved.points.row(i).norm() - 1), 5e-5);
  }
}

TEST(MovingLeastSquares, RefuseRowsThatDoNotMatch) {
  const auto sphere = clouds::sphere(10);
  EXPECT_THROW(moving_least_squares(sphere.points, sphere.normals, sphere.points,
                                    nearest_neighbors(sphere.points, 4).topRows(5)),
               InvalidArgument);
  EXPECT_THROW(moving_least_squares(sphere.points, sphere.normals, sphere.points, Neighbors::Constant(10, 4, 10)),
               InvalidArgument);
}

}  // namespace
}  // namespace hdpea
