// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/tangent_basis.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "hdpea_cpp/errors.hpp"
#include "hdpea_cpp/parallel.hpp"

namespace hdpea {
namespace {

// Embeddings are far the most common: a fixed size is several times faster to decompose.
template <int D>
using Covariance = Eigen::Matrix<double, D, D>;

template <int D>
void write_basis(const CoordinatesRef& coordinates, const NeighborsRef& neighbors, Index i, Coordinates& bases) {
  using Vector = Eigen::Matrix<double, D, 1>;
  const Index d = coordinates.cols();
  Covariance<D> covariance = Covariance<D>::Zero(d, d);
  Vector sum = Vector::Zero(d);
  double count = 1;  // the point itself, at the origin of its own neighbourhood
  for (Index j : neighbors.row(i)) {
    if (j < 0) continue;
    const Vector offset = (coordinates.row(j) - coordinates.row(i)).transpose();
    covariance.noalias() += offset * offset.transpose();
    sum += offset;
    count += 1;
  }
  covariance.noalias() -= sum * sum.transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Covariance<D>> solver(covariance);
  bases.row(i).head(d) = solver.eigenvectors().col(d - 1).transpose();
  bases.row(i).tail(d) = solver.eigenvectors().col(d - 2).transpose();
}

}  // namespace

Coordinates tangent_bases(const CoordinatesRef& coordinates, const NeighborsRef& neighbors) {
  require(coordinates.rows() == neighbors.rows(), "coordinates and neighbors must have one row per point");
  require(coordinates.cols() >= 2, "a surface needs at least two dimensions");
  Coordinates bases(coordinates.rows(), 2 * coordinates.cols());
  parallel_for(coordinates.rows(), [&](Index i) {
    if (coordinates.cols() == 8) return write_basis<8>(coordinates, neighbors, i, bases);
    write_basis<Eigen::Dynamic>(coordinates, neighbors, i, bases);
  });
  return bases;
}

Coordinates tangent_bases_across(const PointsRef& normals) {
  Coordinates bases(normals.rows(), 6);
  for (Index i = 0; i < normals.rows(); ++i) {
    const Eigen::Vector3d normal = normals.row(i).transpose();
    const Eigen::Vector3d u = normal.unitOrthogonal();
    bases.row(i) << u.transpose(), normal.cross(u).transpose();
  }
  return bases;
}

}  // namespace hdpea
