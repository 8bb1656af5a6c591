// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/simplification.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

const Points kNone(0, 3);

SimplifiedMesh simplified(const shapes::Mesh& mesh, const MeshBudget& budget) {
  return simplify_mesh(mesh.vertices, mesh.vertices, mesh.faces, kNone, kNone, budget, {});
}

double area(const SimplifiedMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1)),
                             c = mesh.vertices.row(mesh.faces(f, 2));
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

TEST(Simplification, MeetsTheBudgetAndKeepsTheTopology) {
  const SimplifiedMesh torus = simplified(shapes::torus(60, 30), {.vertices = 300});
  EXPECT_EQ(torus.vertices.rows(), 300);
  EXPECT_EQ(torus.coordinates.rows(), 300);
  const MeshCheck check = check_mesh(torus.vertices, torus.faces);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(check.boundary_loops, 0);
  EXPECT_EQ(torus.vertices.rows() - torus.faces.rows() / 2, 0);
}

TEST(Simplification, StaysOnTheSurface) {
  const auto torus = shapes::torus(60, 30);
  const SimplifiedMesh small = simplified(torus, {.vertices = 300});
  // Edges of 0.23 across a tube of radius 0.4 are 0.016 off.
  EXPECT_LT(closest_surface_points(small.vertices, small.faces, torus.vertices).distance.maxCoeff(), 0.03);
}

TEST(Simplification, MeetsABudgetOfFaces) {
  const SimplifiedMesh square = simplified(shapes::grid(20, 20), {.faces = 100});
  EXPECT_LE(square.faces.rows(), 100);
  EXPECT_GE(square.faces.rows(), 98);
}

TEST(Simplification, LeavesAMeshWithinTheBudgetAlone) {
  const auto grid = shapes::grid(4, 4);
  const SimplifiedMesh same = simplified(grid, {25, 32});
  EXPECT_EQ(same.vertices, grid.vertices);
  EXPECT_EQ(same.faces, grid.faces);
}

TEST(Simplification, KeepsTheBorderInPlace) {
  const SimplifiedMesh square = simplified(shapes::grid(20, 20), {.vertices = 40});
  EXPECT_NEAR(area(square), 1, 1e-3);
  EXPECT_EQ(check_mesh(square.vertices, square.faces).boundary_loops, 1);
}

TEST(Simplification, GivesTheCentroidsOfTheParts) {
  const SimplifiedMesh square = simplified(shapes::grid(20, 20), {.vertices = 100});
  const double farthest = (square.coordinates - square.vertices).rowwise().norm().maxCoeff();
  EXPECT_LT(farthest, 0.1);   // an edge
  EXPECT_GT(farthest, 0.01);  // borders stay, the parts of their vertices lie inwards
}

TEST(Simplification, KeepsACrease) {
  auto roof = shapes::grid(20, 20);
  roof.vertices.col(2) = -(roof.vertices.col(0).array() - 0.5).abs();
  const SimplifiedMesh small = simplified(roof, {.vertices = 60});
  EXPECT_LT(closest_surface_points(small.vertices, small.faces, roof.vertices).distance.maxCoeff(), 2e-3);
}

TEST(Simplification, SpreadsWhatIsFlatEvenlyInTheEmbedding) {
  const auto grid = shapes::grid(30, 30);
  Coordinates stretched = grid.vertices;
  stretched.col(0) *= 4;
  const SimplifiedMesh small = simplify_mesh(grid.vertices, stretched, grid.faces, kNone, kNone, {.vertices = 100}, {});
  Eigen::RowVector3d reach = Eigen::RowVector3d::Zero();
  for (Index f = 0; f < small.faces.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      reach += (small.vertices.row(small.faces(f, (i + 1) % 3)) - small.vertices.row(small.faces(f, i))).cwiseAbs();
    }
  }
  EXPECT_GT(reach(1), 2 * reach(0));
  EXPECT_LT(reach(1), 8 * reach(0));
}

TEST(Simplification, StopsWhereNothingCanBeCollapsed) {
  const auto tetrahedron = shapes::tetrahedron();
  EXPECT_EQ(simplified(tetrahedron, {.vertices = 3}).faces, tetrahedron.faces);
}

TEST(Simplification, RefusesBrokenInput) {
  const MeshBudget ten{.vertices = 10};
  auto grid = shapes::grid(4, 4);
  EXPECT_THROW(simplify_mesh(grid.vertices, Coordinates(3, 8), grid.faces, kNone, kNone, ten, {}), InvalidArgument);
  EXPECT_THROW(simplify_mesh(grid.vertices, grid.vertices, grid.faces, kNone, kNone, ten, {.evenness = -1}),
               InvalidArgument);
  EXPECT_THROW(simplified(grid, {.vertices = -1}), InvalidArgument);
  EXPECT_THROW(simplified(grid, {.faces = std::numeric_limits<Index>::min()}), InvalidArgument);
  Faces outside = grid.faces;
  outside(0, 0) = 25;
  EXPECT_THROW(simplify_mesh(grid.vertices, grid.vertices, outside, kNone, kNone, ten, {}), InvalidArgument);
  Faces turned = grid.faces;
  turned.row(0) = turned.row(0).reverse().eval();
  EXPECT_THROW(simplify_mesh(grid.vertices, grid.vertices, turned, kNone, kNone, ten, {}), InvalidArgument);
  const auto bow_tie = shapes::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_THROW(simplified(bow_tie, {.vertices = 4}), InvalidArgument);
  grid.vertices(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simplified(grid, ten), InvalidArgument);
}

SimplifiedMesh within(const shapes::Mesh& mesh, double error) {
  const Points normals = mesh.vertices.rowwise().normalized();
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(mesh.vertices.rows(), 0.2);
  return simplify_within(mesh.vertices, mesh.vertices, mesh.faces, mesh.vertices, normals, radii, error, {});
}

TEST(Simplification, KeepsAnError) {
  const auto sphere = shapes::sphere(40, 20);
  Index more = sphere.faces.rows() + 1;
  for (const double error : {0.01, 0.03, 0.1}) {
    const SimplifiedMesh small = within(sphere, error);
    EXPECT_LT(closest_surface_points(small.vertices, small.faces, sphere.vertices).distance.maxCoeff(), error * 1.001);
    const MeshCheck check = check_mesh(small.vertices, small.faces);
    EXPECT_TRUE(check.manifold() && check.oriented() && check.closed());
    EXPECT_LT(small.faces.rows(), more);
    more = small.faces.rows();
  }
}

TEST(Simplification, SplitsFacesUntilTheErrorIsKept) {
  const auto fine = shapes::sphere(40, 20);
  const SimplifiedMesh coarse = within(fine, 0.2);
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(fine.vertices.rows(), 0.2);
  const SimplifiedMesh small = simplify_within(coarse.vertices, coarse.vertices, coarse.faces, fine.vertices,
                                               fine.vertices.rowwise().normalized(), radii, 0.05, {});
  EXPECT_GT(small.faces.rows(), coarse.faces.rows());
  EXPECT_LT(closest_surface_points(small.vertices, small.faces, fine.vertices).distance.maxCoeff(), 0.05 * 1.001);
}

TEST(Simplification, FoldsNothingWithinAnErrorThatIsWiderThanTheNoise) {
  auto hills = shapes::grid(100, 100);
  Points normals(hills.vertices.rows(), 3);
  for (Index v = 0; v < hills.vertices.rows(); ++v) {
    const double x = 9 * hills.vertices(v, 0), y = 9 * hills.vertices(v, 1), noise = std::fmod(0.618034 * v, 1.0) - 0.5;
    hills.vertices(v, 2) = 0.03 * (std::sin(x) + std::cos(y)) + 0.01 * noise;
    normals.row(v) = Eigen::RowVector3d(-0.27 * std::cos(x), 0.27 * std::sin(y), 1).normalized();
  }
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(hills.vertices.rows(), 0.02);
  for (const double error : {0.005, 0.007, 0.01}) {
    const SimplifiedMesh small =
        simplify_within(hills.vertices, hills.vertices, hills.faces, hills.vertices, normals, radii, error, {});
    for (Index f = 0; f < small.faces.rows(); ++f) {
      const Eigen::RowVector3d a = small.vertices.row(small.faces(f, 0));
      const Eigen::RowVector3d ab = small.vertices.row(small.faces(f, 1)) - a;
      EXPECT_GT(ab.cross(small.vertices.row(small.faces(f, 2)) - a).z(), 0) << "face " << f << " at " << error;
    }
  }
}

TEST(Simplification, CanBeCancelledHalfway) {
  const auto torus = shapes::torus(60, 30);
  double seen = 0;
  const auto stop_halfway = [&](double fraction) {
    seen = fraction;
    return fraction < 0.5;
  };
  EXPECT_THROW(
      simplify_mesh(torus.vertices, torus.vertices, torus.faces, kNone, kNone, {.faces = 601}, {}, stop_halfway),
      Cancelled);
  EXPECT_LT(seen, 0.6);
}

}  // namespace
}  // namespace hdpea
