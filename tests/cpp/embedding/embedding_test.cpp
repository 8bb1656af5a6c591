// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/embedding/embedding.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <optional>

#include "hdpea_cpp/base/cholesky.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/restricted_voronoi.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

struct Embedded {
  Candidates soup;
  Coordinates coordinates;  // [p, psi]
};

Embedded embedded(const clouds::Cloud& cloud, double disk, double radius, const EmbeddingOptions& options,
                  const std::optional<Coordinates>& initial = {}) {
  const Neighbors neighbors = nearest_neighbors(cloud.points, 40);
  const Index n = cloud.points.rows();
  Embedded result{restricted_voronoi_candidates(cloud.points, tangent_bases_across(cloud.normals), neighbors,
                                                Eigen::VectorXd::Constant(n, disk)),
                  Coordinates(n, 8)};
  const Curvature curvature = estimate_curvature(cloud.points, cloud.normals, neighbors, radius);
  const Eigen::VectorXd weights = result.soup.counts.cast<double>() / 3;
  // Solved before it is put in place: Eigen's comma aborts if an exception leaves it unfinished.
  const Coordinates psi =
      solve_embedding(cloud.points, cloud.normals, curvature, result.soup.triangles, weights, options, {}, initial);
  result.coordinates << cloud.points, psi;
  return result;
}

/// Stretches along the parallels and along the meridians of a surface of revolution about z, by least squares:
/// squared lengths of the embedded edges are s1^2 u^2 + 2 g u v + s2^2 v^2 in those of the edges themselves.
Eigen::Vector2d stretches(const clouds::Cloud& cloud, const Embedded& embedded) {
  Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Index t = 0; t < embedded.soup.triangles.rows(); ++t) {
    const Index a = embedded.soup.triangles(t, 0), b = embedded.soup.triangles(t, 1);
    if (std::abs(cloud.points(a, 2)) > 0.3) continue;  // away from the borders
    const Eigen::RowVector3d normal = cloud.normals.row(a), edge = cloud.points.row(b) - cloud.points.row(a);
    const Eigen::RowVector3d parallel = Eigen::RowVector3d(-normal.y(), normal.x(), 0).normalized();
    const double u = edge.dot(parallel), v = edge.dot(normal.cross(parallel));
    const Eigen::Vector3d terms(u * u, 2 * u * v, v * v);
    system += terms * terms.transpose();
    right += terms * (embedded.coordinates.row(b) - embedded.coordinates.row(a)).squaredNorm();
  }
  const Eigen::Vector3d squares = system.ldlt().solve(right);
  return {std::sqrt(squares(0)), std::sqrt(squares(2))};
}

TEST(Embedding, StretchesACylinderAroundItByTheMetricAndNotAlongIt) {
  // k = 16 around it, so s = sqrt(k) = 4 there; along it the metric is flat and s = 1.
  const auto cylinder = clouds::cylinder(8000, 1.0 / 16, 0.8);
  EmbeddingOptions options;
  options.metric_scale = 1;
  options.bending_length = 0.004;
  const Eigen::Vector2d stretch = stretches(cylinder, embedded(cylinder, 0.03, 0.02, options));
  EXPECT_NEAR(stretch(0), 4, 0.6);
  EXPECT_NEAR(stretch(1), 1, 0.15);
}

TEST(Embedding, LeavesAPlaneAsItIs) {
  const auto plane = clouds::plane(2000);
  const Coordinates coordinates = embedded(plane, 0.06, 0.1, {}).coordinates;
  const Coordinates psi = coordinates.rightCols<5>().rowwise() - coordinates.row(0).tail<5>();
  EXPECT_LT(psi.cwiseAbs().maxCoeff(), 0.01);
}

TEST(Embedding, KeepsSeparateSheetsApart) {
  const auto sheets = clouds::joined(clouds::plane(1000), clouds::flipped(clouds::plane(1000, 0.2)));
  const Coordinates coordinates = embedded(sheets, 0.06, 0.1, {}).coordinates;
  EXPECT_NEAR((coordinates.row(0).tail<5>() - coordinates.row(1000).tail<5>()).norm(), 0.4, 0.02);
}

TEST(Embedding, AStrongerMetricStretchesMore) {
  const auto sphere = clouds::sphere(2000, 0.2);
  EmbeddingOptions weak, strong;
  strong.metric_scale = 4;
  const Eigen::Vector2d less = stretches(sphere, embedded(sphere, 0.05, 0.05, weak));
  const Eigen::Vector2d more = stretches(sphere, embedded(sphere, 0.05, 0.05, strong));
  EXPECT_GT(more.minCoeff(), 1.5 * less.maxCoeff());
}

TEST(Embedding, GoesOnFromAnInitialPsiInItsGauge) {
  const auto cylinder = clouds::cylinder(2000, 1.0 / 16, 0.4);
  EmbeddingOptions whole, little;
  little.iterations = 3;
  const Coordinates solved = embedded(cylinder, 0.06, 0.04, whole).coordinates.rightCols<5>();
  const Eigen::MatrixXd turn = Eigen::MatrixXd::Random(5, 5).householderQr().householderQ();
  const Coordinates turned = solved * turn;
  const Coordinates next = embedded(cylinder, 0.06, 0.04, little, turned).coordinates.rightCols<5>();
  const Coordinates anew = embedded(cylinder, 0.06, 0.04, little).coordinates.rightCols<5>();
  EXPECT_LT((next - turned).norm(), 0.1 * (anew - solved).norm());
}

TEST(Embedding, RefusesABadContract) {
  const auto sphere = clouds::sphere(200);
  EmbeddingOptions options;
  options.max_stretch = 0.5;
  EXPECT_THROW(embedded(sphere, 0.5, 0.5, options), InvalidArgument);
  const Curvature curvature{{200, 2}, Points(200, 3)};
  const Faces faces = Faces::Constant(1, 3, 200);
  EXPECT_THROW(solve_embedding(sphere.points, sphere.normals, curvature, faces, Eigen::VectorXd::Ones(1), {}),
               InvalidArgument);
  const Coordinates narrow = Coordinates::Zero(200, 4);
  EXPECT_THROW(embedded(sphere, 0.5, 0.5, {}, narrow), InvalidArgument);
  const Curvature nothing{{0, 2}, Points(0, 3)};
  EXPECT_THROW(solve_embedding(Points(0, 3), Points(0, 3), nothing, Faces(0, 3), Eigen::VectorXd(0), {}),
               InvalidArgument);
}

TEST(Embedding, NeedsAnExtent) {
  const auto sphere = clouds::sphere(200);
  const Curvature curvature{Eigen::MatrixXd::Ones(200, 2), sphere.normals};
  const Faces faces = Eigen::RowVector<Index, 3>(0, 1, 2);
  EXPECT_THROW(solve_embedding(Points::Ones(200, 3), sphere.normals, curvature, faces, Eigen::VectorXd::Ones(1), {}),
               CannotReconstruct);
}

TEST(Embedding, SaysWhenALengthIsOutOfProportion) {
  EmbeddingOptions options;
  options.bending_length = 1e300;
  EXPECT_THROW(embedded(clouds::sphere(200), 0.5, 0.5, options), CannotReconstruct);
}

TEST(Embedding, StopsWhenProgressSaysSo) {
  const auto sphere = clouds::sphere(200);
  const Curvature curvature =
      estimate_curvature(sphere.points, sphere.normals, nearest_neighbors(sphere.points, 12), 1);
  const Faces faces = Eigen::RowVector<Index, 3>(0, 1, 2);
  EXPECT_THROW(solve_embedding(sphere.points, sphere.normals, curvature, faces, Eigen::VectorXd::Ones(1), {},
                               [](double fraction) { return fraction < 0.5; }),
               Cancelled);
}

TEST(Cholesky, SolvesAllColumnsAtOnce) {
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(30, 30);
  const Eigen::MatrixXd matrix = random * random.transpose() + Eigen::MatrixXd::Identity(30, 30);
  const Cholesky::Columns right = Cholesky::Columns::Random(30, 5);
  Cholesky::Columns solution = right;
  Cholesky(matrix.sparseView()).solve_in_place(solution);
  EXPECT_LT((matrix * solution - right).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Cholesky, RefusesAnIndefiniteMatrix) {
  EXPECT_THROW(Cholesky(SparseMatrix(Eigen::VectorXd::Constant(3, -1).asDiagonal())), CannotReconstruct);
}

}  // namespace
}  // namespace hdpea
