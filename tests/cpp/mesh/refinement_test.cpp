// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/refinement.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "helpers/clouds.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

double rms(const Points& vertices, const Faces& faces, const Points& points) {
  const Eigen::VectorXd distance = closest_surface_points(vertices, faces, points).distance;
  return std::sqrt(distance.squaredNorm() / double(distance.size()));
}

TEST(Refinement, LeavesAPerfectFitAlone) {
  const auto mesh = shapes::grid(8, 8);
  const auto plane = clouds::plane(1000);
  const Points refined = refine_vertices(mesh.vertices, mesh.faces, plane.points, plane.normals, {});
  EXPECT_LT((refined - mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Refinement, BringsAnInscribedTorusCloserToIt) {
  const auto mesh = shapes::torus(24, 12), dense = shapes::torus(120, 60);
  Points normals(dense.vertices.rows(), 3);
  for (Index i = 0; i < normals.rows(); ++i) {
    const Eigen::RowVector3d point = dense.vertices.row(i);
    normals.row(i) = (point - Eigen::RowVector3d(point.x(), point.y(), 0).normalized()).normalized();
  }
  const Points refined = refine_vertices(mesh.vertices, mesh.faces, dense.vertices, normals, {});
  EXPECT_LT(rms(refined, mesh.faces, dense.vertices), 0.6 * rms(mesh.vertices, mesh.faces, dense.vertices));
}

TEST(Refinement, PointsBeyondAFixedRimMoveNothingWithin) {
  const auto mesh = shapes::grid(6, 6);
  Mask rim(mesh.vertices.rows());
  for (Index v = 0; v < rim.size(); ++v) {
    const double x = mesh.vertices(v, 0), y = mesh.vertices(v, 1);
    rim(v) = x == 0 || x == 1 || y == 0 || y == 1;
  }
  const auto plane = clouds::plane(1000);
  // Those of the next tile, where the surface bends down: their feet are on the rim.
  Points points(2000, 3), normals = plane.normals.replicate(2, 1);
  points << plane.points, plane.points + Eigen::RowVector3d(1, 0, -0.2).replicate(1000, 1);
  const Points refined = refine_vertices(mesh.vertices, mesh.faces, points, normals, {}, {}, rim);
  EXPECT_LT((refined - mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Refinement, NeverFlipsAFace) {
  // Points scattered far off the mesh pull hard; faces turn by less than the limit in each round.
  const auto mesh = shapes::grid(6, 6);
  auto cloud = clouds::plane(400);
  for (Index i = 0; i < 400; ++i) cloud.points(i, 2) = 0.5 * std::sin(40 * double(i));
  RefinementOptions options;
  options.rounds = 1;
  const Points refined = refine_vertices(mesh.vertices, mesh.faces, cloud.points, cloud.normals, options);
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d a = refined.row(mesh.faces(f, 0));
    EXPECT_GT((refined.row(mesh.faces(f, 1)) - a).cross(refined.row(mesh.faces(f, 2)) - a).z(), 0);
  }
}

TEST(Refinement, DoesNotDependOnTheOrderOfTheFaces) {
  // A right-angled ridge: the feet of points above it lie on the edge that two faces share, and only one of
  // them agrees with the point's normal.
  const auto roof = shapes::make({{0, 0, 0}, {0, 1, 0}, {1, 0.5, -1}, {-1, 0.5, -1}}, {{0, 2, 1}, {0, 1, 3}});
  Points points(40, 3), normals(40, 3);
  for (Index i = 0; i < 40; ++i) {
    points.row(i) << 0, (double(i) + 0.5) / 40, 0.05;
    normals.row(i) = Eigen::RowVector3d(i % 2 == 0 ? 1 : -1, 0, 0.8).normalized();
  }
  const Faces reversed = roof.faces.colwise().reverse();
  const Points refined = refine_vertices(roof.vertices, roof.faces, points, normals, {});
  EXPECT_LT((refined - refine_vertices(roof.vertices, reversed, points, normals, {})).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(refined(0, 2), 0.03);
}

TEST(Refinement, NoVertexLeavesTheCloud) {
  // Three noisy points in the middle of a triangle tell a slope of 45 degrees, which would lift a corner by 0.5.
  const auto triangle = shapes::make({{-0.5, 0, 0}, {0.5, 0, 0}, {0, 0.9, 0}}, {{0, 1, 2}});
  Points points(3, 3);
  points << -0.02, 0.3, -0.02, 0.02, 0.3, 0.02, 0, 0.34, 0;
  const Points normals = Eigen::RowVector3d::UnitZ().replicate(3, 1);
  RefinementOptions loose = RefinementOptions::within_error();
  const Points refined = refine_vertices(triangle.vertices, triangle.faces, points, normals, loose);
  EXPECT_LT(refined.col(2).cwiseAbs().maxCoeff(), 0.1);
  loose.max_gap = 100;
  const Points lifted = refine_vertices(triangle.vertices, triangle.faces, points, normals, loose);
  EXPECT_GT(lifted.col(2).cwiseAbs().maxCoeff(), 0.2);
}

TEST(Refinement, PointsOfWhatIsMissingPullNothing) {
  const auto mesh = shapes::grid(8, 8);
  const auto plane = clouds::plane(1000);
  Points points(1040, 3), normals = plane.normals.row(0).replicate(1040, 1);
  points << plane.points, (plane.points.topRows(40) * 0.1).rowwise() + Eigen::RowVector3d(0.5, 0.5, 3);
  RefinementOptions options;
  const Points refined = refine_vertices(mesh.vertices, mesh.faces, points, normals, options);
  EXPECT_LT((refined - mesh.vertices).cwiseAbs().maxCoeff(), 1e-9);
  options.max_distance = 100;
  const Points drawn = refine_vertices(mesh.vertices, mesh.faces, points, normals, options);
  EXPECT_GT((drawn - mesh.vertices).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Refinement, NoRoundsChangeNothing) {
  const auto mesh = shapes::tetrahedron();
  const auto sphere = clouds::sphere(100);
  RefinementOptions none;
  none.rounds = 0;
  EXPECT_EQ(refine_vertices(mesh.vertices, mesh.faces, sphere.points, sphere.normals, none), mesh.vertices);
}

TEST(Refinement, RefusesABadContract) {
  const auto mesh = shapes::tetrahedron();
  const auto sphere = clouds::sphere(100);
  RefinementOptions options;
  const Faces beyond = Faces::Constant(4, 3, mesh.vertices.rows());
  EXPECT_THROW(refine_vertices(mesh.vertices, beyond, sphere.points, sphere.normals, options), InvalidArgument);
  options.pull = 0;
  EXPECT_THROW(refine_vertices(mesh.vertices, mesh.faces, sphere.points, sphere.normals, options), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
