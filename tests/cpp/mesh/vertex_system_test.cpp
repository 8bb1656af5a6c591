// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/vertex_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "hdpea_cpp/base/errors.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

TEST(VertexSystem, SolvesWhatADenseMatrixSolves) {
  const auto mesh = shapes::torus(12, 6);
  const Index count = mesh.vertices.rows();
  VertexSystem system(count, mesh.faces);
  Eigen::MatrixXd dense = 1e-3 * Eigen::MatrixXd::Identity(3 * count, 3 * count);
  system.add_to_diagonal(1e-3);
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d weights(0.5, 0.3, 0.2);
    const Eigen::RowVector3d direction = mesh.vertices.row(mesh.faces(f, 0)).normalized();
    system.add(f, weights, direction);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(3 * count);
    for (int i = 0; i < 3; ++i) row.segment<3>(3 * mesh.faces(f, i)) += weights(i) * direction.transpose();
    dense += row * row.transpose();
  }
  const Points right = mesh.vertices.colwise().reverse();
  const Eigen::VectorXd expected = dense.ldlt().solve(right.reshaped<Eigen::RowMajor>());
  const Points solution = system.solve(right, mesh.vertices);
  EXPECT_LT((solution.reshaped<Eigen::RowMajor>() - expected).norm(), 1e-8 * expected.norm());
  // Beginning at the solution, nothing is left to do.
  EXPECT_LT((system.solve(right, solution) - solution).norm(), 1e-8 * solution.norm());
}

TEST(VertexSystem, SolvesForTheOthersWhereSomeVerticesAreFixed) {
  const auto mesh = shapes::torus(12, 6);
  const Index count = mesh.vertices.rows();
  VertexSystem system(count, mesh.faces);
  Eigen::MatrixXd dense = 1e-3 * Eigen::MatrixXd::Identity(count, count);
  system.add_to_diagonal(1e-3);
  const Eigen::RowVector3d weights(0.5, 0.3, 0.2);
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    for (Index axis = 0; axis < 3; ++axis) system.add(f, weights, Eigen::RowVector3d::Unit(axis));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) dense(mesh.faces(f, i), mesh.faces(f, j)) += weights(i) * weights(j);
    }
  }
  const Points right = mesh.vertices.colwise().reverse();
  Mask fixed = Mask::Constant(count, false);
  fixed.head(count / 3).setConstant(true);
  // Where a vertex is fixed, its equation is that it stays.
  Eigen::MatrixXd held = dense;
  Eigen::MatrixXd sums = right;
  for (Index v = 0; v < count / 3; ++v) {
    held.row(v) = Eigen::RowVectorXd::Unit(count, v);
    sums.row(v) = mesh.vertices.row(v);
  }
  const Eigen::MatrixXd expected = held.partialPivLu().solve(sums);
  const Points solution = system.solve(right, mesh.vertices, fixed);
  EXPECT_EQ(solution.topRows(count / 3), mesh.vertices.topRows(count / 3));
  EXPECT_LT((solution - expected).norm(), 1e-8 * expected.norm());
}

TEST(VertexSystem, RefusesNumbersThatOverflow) {
  const auto mesh = shapes::tetrahedron();
  VertexSystem system(mesh.vertices.rows(), mesh.faces);
  system.add_to_diagonal(1);
  EXPECT_THROW(system.solve(1e300 * mesh.vertices, mesh.vertices), CannotReconstruct);
}

}  // namespace
}  // namespace hdpea
