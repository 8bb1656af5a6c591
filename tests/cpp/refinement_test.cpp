// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/refinement.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"
#include "hdpea_cpp/errors.hpp"
#include "hdpea_cpp/mesh_check.hpp"
#include "hdpea_cpp/surface_distance.hpp"
#include "shapes.hpp"

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
  options.pull = 0;
  EXPECT_THROW(refine_vertices(mesh.vertices, mesh.faces, sphere.points, sphere.normals, options), InvalidArgument);
}

}  // namespace
}  // namespace hdpea
