// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/winding_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

constexpr double one_over_4pi = 1 / (4 * std::numbers::pi);

struct Fields {
  Eigen::VectorXd winding;
  Points normal_field, adjoint;
};

Fields by_tree(const Points& points, const Points& moments, const Eigen::VectorXd& charges, double width) {
  const WindingTree tree(points);
  return {tree.winding(moments, width), tree.normal_field(moments, width), tree.adjoint(charges, width)};
}

/// The sums of the header, pair by pair.
Fields by_pairs(const Points& points, const Points& moments, const Eigen::VectorXd& charges, double width) {
  const Index n = points.rows();
  Fields fields{Eigen::VectorXd::Zero(n), Points::Zero(n, 3), Points::Zero(n, 3)};
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Eigen::RowVector3d offset = points.row(j) - points.row(i), m = moments.row(j);
      const double squared = offset.squaredNorm() + width * width;
      const double weight = one_over_4pi / (squared * std::sqrt(squared));
      fields.winding[i] += weight * m.dot(offset);
      fields.normal_field.row(i) += weight * (m - 3 * m.dot(offset) / squared * offset);
      fields.adjoint.row(i) -= weight * charges[j] * offset;
    }
  }
  return fields;
}

Eigen::VectorXd random_signs(Index n) {
  Eigen::VectorXd signs(n);
  for (Index i = 0; i < n; ++i) signs[i] = clouds::weyl(i * i).x() < 0.5 ? -1 : 1;
  return signs;
}

template <class Values>
double relative_rms(const Values& found, const Values& exact) {
  return (found - exact).norm() / exact.norm();
}

/// Two shells so close that far cells hold both, and their moments all but cancel.
clouds::Cloud thin_shell() {
  return clouds::joined(clouds::sphere(2000, 300), clouds::flipped(clouds::sphere(2000, 290)));
}

void expect_within(const Fields& found, const Fields& exact, double bound) {
  EXPECT_LT(relative_rms(found.winding, exact.winding), bound);
  EXPECT_LT(relative_rms(found.normal_field, exact.normal_field), bound);
  EXPECT_LT(relative_rms(found.adjoint, exact.adjoint), bound);
}

class Tree : public testing::TestWithParam<double> {};

TEST_P(Tree, AddsUpASurfaceAsThePairsDo) {
  const auto [points, normals] = thin_shell();
  const Points moments = 100 * normals;
  const Eigen::VectorXd charges = Eigen::VectorXd::Ones(points.rows());
  expect_within(by_tree(points, moments, charges, GetParam()), by_pairs(points, moments, charges, GetParam()), 0.08);
}

TEST_P(Tree, AddsUpRandomSignsAsThePairsDo) {
  const auto [points, normals] = thin_shell();
  const Eigen::VectorXd charges = random_signs(points.rows());
  const Points moments = normals.array().colwise() * charges.array();
  expect_within(by_tree(points, moments, charges, GetParam()), by_pairs(points, moments, charges, GetParam()), 0.15);
}

INSTANTIATE_TEST_SUITE_P(Widths, Tree, testing::Values(1.0, 5.0, 30.0));

TEST(WindingTree, IsAHalfOnAClosedSurface) {
  const auto sphere = clouds::sphere(5000);
  const Points moments = 4 * std::numbers::pi / 5000 * sphere.normals;
  const Eigen::VectorXd chi = WindingTree(sphere.points).winding(moments, 0.01);
  EXPECT_LT((chi.array() - 0.5).abs().maxCoeff(), 0.05);
}

TEST(WindingTree, DoesNotDependOnTheThreadsNorOnTheOrder) {
  const auto [points, normals] = thin_shell();
  const Eigen::VectorXd charges = random_signs(points.rows());
  std::vector<Index> backwards(static_cast<std::size_t>(points.rows()));
  std::iota(backwards.rbegin(), backwards.rend(), Index{0});
  set_thread_limit(1);
  const Fields alone = by_tree(points, normals, charges, 5);
  set_thread_limit(0);
  const Fields together = by_tree(points, normals, charges, 5);
  EXPECT_EQ(alone.winding, together.winding);
  EXPECT_EQ(alone.normal_field, together.normal_field);
  EXPECT_EQ(alone.adjoint, together.adjoint);
  const Fields reversed = by_tree(points(backwards, Eigen::all), normals(backwards, Eigen::all), charges(backwards), 5);
  EXPECT_EQ(reversed.winding, together.winding(backwards));
  EXPECT_EQ(reversed.normal_field, together.normal_field(backwards, Eigen::all));
  EXPECT_EQ(reversed.adjoint, together.adjoint(backwards, Eigen::all));
}

TEST(WindingTree, OfOnePointSeesOnlyItself) {
  const WindingTree tree(Points::Zero(1, 3));
  const Points up = Eigen::RowVector3d::UnitZ();
  EXPECT_EQ(tree.winding(up, 1)[0], 0);
  EXPECT_TRUE(tree.normal_field(up, 1).isApprox(one_over_4pi * up, 1e-6));
}

TEST(WindingTree, RefusesWhatIsNoCloud) {
  EXPECT_THROW(WindingTree(Points(0, 3)), InvalidArgument);
  EXPECT_THROW(WindingTree(Points::Constant(2, 3, std::nan(""))), InvalidArgument);
  const WindingTree tree(clouds::sphere(50).points);
  EXPECT_THROW(tree.winding(Points::Zero(3, 3), 1), InvalidArgument);
  EXPECT_THROW(tree.normal_field(Points::Zero(3, 3), 1), InvalidArgument);
  EXPECT_THROW(tree.adjoint(Eigen::VectorXd::Zero(3), 1), InvalidArgument);
  EXPECT_THROW(tree.winding(Points::Zero(50, 3), 0), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
