// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

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

TEST(Normals, OfACubeStaySharpBesideItsEdges) {
  const auto box = clouds::cube(900);
  const Points normals = estimate_normals(box.points, nearest_neighbors(box.points, 16));
  const Eigen::ArrayXd cosines = (normals.array() * box.normals.array()).rowwise().sum().abs();
  EXPECT_GT((cosines > 0.99).cast<double>().mean(), 0.97);
}

TEST(Normals, ALonelyPointGetsAUnitVector) {
  const Points point = Points::Zero(1, 3);
  EXPECT_NEAR(estimate_normals(point, Neighbors::Constant(1, 4, -1)).norm(), 1, 1e-12);
}

TEST(Normals, RefuseWhatIsIllegal) {
  const auto sphere = clouds::sphere(50);
  const Neighbors neighbors = nearest_neighbors(sphere.points, 4);
  EXPECT_THROW(estimate_normals(sphere.points, neighbors.topRows(3)), InvalidArgument);
  EXPECT_THROW(estimate_normals(sphere.points, Neighbors::Constant(50, 4, 50)), InvalidArgument);
  EXPECT_THROW(estimate_normals(Points::Constant(50, 3, std::nan("")), neighbors), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
