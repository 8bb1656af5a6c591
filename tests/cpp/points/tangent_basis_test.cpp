// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/tangent_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

/// Points on the strut x^2 + y^2 = radius^2 with psi = 5 n, as a strong metric across the axis has it.
struct EmbeddedStrut {
  Points normals;
  Coordinates coordinates;
};

EmbeddedStrut strut(Index n, double radius) {
  EmbeddedStrut result{Points(n, 3), Coordinates::Zero(n, 8)};
  for (Index i = 0; i < n; ++i) {
    const double angle = 2.399963 * double(i);
    result.normals.row(i) << std::cos(angle), std::sin(angle), 0;
    result.coordinates.row(i).head<3>() = radius * result.normals.row(i);
    result.coordinates(i, 2) = double(i) / double(n);
    result.coordinates.row(i).segment<3>(3) = 5 * radius * result.normals.row(i);
  }
  return result;
}

double largest_error(const EmbeddedStrut& strut, const Coordinates& bases) {
  double worst = 0;
  for (Index i = 0; i < bases.rows(); ++i) {
    Eigen::MatrixXd basis(8, 2);
    basis << bases.row(i).head<8>().transpose(), bases.row(i).tail<8>().transpose();
    Eigen::Vector<double, 8> axis = Eigen::Vector<double, 8>::Unit(2), around = axis * 0;
    const Eigen::Vector3d tangent = Eigen::Vector3d::UnitZ().cross(strut.normals.row(i).transpose());
    around << tangent, 5 * tangent, 0, 0;
    around.normalize();
    worst = std::max({worst, (axis - basis * (basis.transpose() * axis)).norm(),
                      (around - basis * (basis.transpose() * around)).norm()});
  }
  return worst;
}

TEST(TangentBases, AreOrthonormal) {
  const auto surface = strut(2000, 0.1);
  const Coordinates bases =
      tangent_bases(surface.coordinates, surface.normals, nearest_neighbors(surface.coordinates.leftCols(3), 12));
  for (Index i = 0; i < bases.rows(); ++i) {
    EXPECT_NEAR(bases.row(i).head<8>().norm(), 1, 1e-12);
    EXPECT_NEAR(bases.row(i).tail<8>().norm(), 1, 1e-12);
    EXPECT_NEAR(bases.row(i).head<8>().dot(bases.row(i).tail<8>()), 0, 1e-12);
  }
}

TEST(TangentBases, AreThoseOfTheEmbeddedSurface) {
  const auto surface = strut(8000, 0.1);
  const auto neighbors = nearest_neighbors(surface.coordinates.leftCols(3), 12);
  EXPECT_LT(largest_error(surface, tangent_bases(surface.coordinates, surface.normals, neighbors)), 0.05);
}

TEST(TangentBases, HoldWhereNeighborsReachAroundAStrut) {
  // Neighbours up to 60 degrees around: their PCA plane in R^8 would contain the radial direction.
  const auto surface = strut(1000, 0.02);
  const auto neighbors = nearest_neighbors(surface.coordinates.leftCols(3), 12);
  EXPECT_LT(largest_error(surface, tangent_bases(surface.coordinates, surface.normals, neighbors)), 0.3);
}

TEST(TangentBases, OfAPointAloneAreThePlaneAcrossItsNormal) {
  const auto surface = strut(10, 0.1);
  const Coordinates bases = tangent_bases(surface.coordinates, surface.normals, Neighbors::Constant(10, 3, -1));
  for (Index i = 0; i < 10; ++i) {
    EXPECT_NEAR(bases.row(i).head<3>().dot(surface.normals.row(i)), 0, 1e-12);
    EXPECT_NEAR(bases.row(i).segment<5>(3).norm(), 0, 1e-12);
  }
}

TEST(TangentBases, RefuseABadContract) {
  const auto surface = strut(10, 0.1);
  EXPECT_THROW(tangent_bases(surface.coordinates, surface.normals.topRows(9), Neighbors::Constant(10, 3, -1)),
               InvalidArgument);
  EXPECT_THROW(tangent_bases(surface.coordinates.leftCols(2), surface.normals, Neighbors::Constant(10, 3, -1)),
               InvalidArgument);
}

TEST(TangentBases, AcrossNormalsArePerpendicularToThem) {
  const auto sphere = clouds::sphere(100);
  const Coordinates bases = tangent_bases_across(sphere.normals);
  EXPECT_LT((bases.leftCols<3>().array() * sphere.normals.array()).rowwise().sum().abs().maxCoeff(), 1e-12);
  EXPECT_LT((bases.rightCols<3>().array() * sphere.normals.array()).rowwise().sum().abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace hdpea
