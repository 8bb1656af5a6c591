// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/jet_fitting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

Jets jets_of(const clouds::Cloud& cloud, Index neighbors = 24) {
  return fit_jets(cloud.points, cloud.normals, nearest_neighbors(cloud.points, neighbors));
}

Eigen::VectorXd difference(const Jets& jets) {
  return (jets.curvature.principal.col(0) - jets.curvature.principal.col(1)).cwiseAbs();
}

/// The cloud with its points moved along their normals, each by its own share of `most`, either way.
clouds::Cloud rough(clouds::Cloud cloud, double most) {
  for (Index i = 0; i < cloud.points.rows(); ++i) {
    const double number = 43758.5453 * std::sin(12.9898 * static_cast<double>(i + 1));
    cloud.points.row(i) += most * (2 * (number - std::floor(number)) - 1) * cloud.normals.row(i);
  }
  return cloud;
}

TEST(Jets, OfASphereAreOneOverItsRadiusBothWays) {
  const Jets jets = jets_of(clouds::sphere(4000, 2));
  EXPECT_LT((jets.curvature.principal.array() - 0.5).abs().maxCoeff(), 0.01);
}

TEST(Jets, OfACylinderRunAroundItAndVanishAlongIt) {
  const Jets jets = jets_of(clouds::cylinder(4000, 0.5, 2));
  EXPECT_LT((jets.curvature.principal.col(0).array() - 2).abs().maxCoeff(), 0.1);
  EXPECT_LT(jets.curvature.principal.col(1).array().abs().maxCoeff(), 0.1);
  EXPECT_LT(jets.curvature.direction1.col(2).array().abs().maxCoeff(), 0.05);
  EXPECT_LT(jets.curvature_error.maxCoeff(), 0.1);
}

TEST(Jets, ChangeTheirSignWithTheNormals) {
  const auto torus = clouds::torus(4000);
  const Jets outward = jets_of(torus), inward = jets_of(clouds::flipped(torus));
  EXPECT_LT((outward.curvature.principal + inward.curvature.principal).array().abs().maxCoeff(), 1e-9);
  EXPECT_LT((outward.normals + inward.normals).array().abs().maxCoeff(), 1e-9);
}

TEST(Jets, FindTheNormalsByThemselves) {
  const auto torus = clouds::torus(4000);
  const Jets jets = jets_of(torus);
  EXPECT_GT((jets.normals.array() * torus.normals.array()).rowwise().sum().minCoeff(), 0.999);
  EXPECT_LT((jets.normals.array() * jets.curvature.direction1.array()).rowwise().sum().abs().maxCoeff(), 1e-9);
}

TEST(Jets, SayThatAPlaneHasNoDirections) {
  const auto plane = clouds::plane(1000);
  EXPECT_LT(jets_of(plane).curvature.principal.array().abs().maxCoeff(), 1e-9);
  // Noise alone makes curvatures differ by about twice their error, which has a mean ratio of sqrt(pi / 8).
  const Jets jets = jets_of(rough(plane, 2e-3));
  EXPECT_NEAR((jets.curvature_error.array() / difference(jets).array()).mean(), 0.63, 0.2);
}

TEST(Jets, UseMoreNeighborsWhereTheyAreNoisy) {
  const auto clean = clouds::cylinder(4000, 0.5, 2), noisy = rough(clean, 1e-2);
  EXPECT_EQ(jets_of(clean, 200).fitted.maxCoeff(), 24);
  const Jets jets = jets_of(noisy, 200);
  EXPECT_GT(jets.fitted.mean(), 60);
  EXPECT_LT((jets.curvature.principal.col(0).array() - 2).abs().mean(), 0.2);
  EXPECT_LT(jets.curvature.direction1.col(2).array().abs().mean(), 0.1);
}

TEST(Jets, OfTooFewPointsOrALineAreUnknown) {
  const Jets few = jets_of(clouds::sphere(5));
  EXPECT_TRUE(few.curvature.principal.array().isNaN().all());
  EXPECT_TRUE((few.curvature_error.array() == INFINITY).all());
  auto line = clouds::plane(100);
  line.points.rightCols<2>().setZero();
  EXPECT_TRUE(jets_of(line).curvature.principal.array().isNaN().all());
}

TEST(Jets, RefuseWhatCannotBe) {
  const auto sphere = clouds::sphere(100);
  EXPECT_THROW(fit_jets(sphere.points, sphere.normals, nearest_neighbors(sphere.points, 24).topRows(50)),
               InvalidArgument);
  EXPECT_THROW(fit_jets(sphere.points, sphere.normals, nearest_neighbors(sphere.points, 24), {.least_neighbors = 4}),
               InvalidArgument);
}

}  // namespace
}  // namespace hdpea
