// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/anisotropic_remeshing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/self_intersections.hpp"
#include "hdpea_cpp/mesh/simplification.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

const Points kNoPoints(0, 3);

/// A fine mesh collapsed to few vertices, and the middles of its faces as the points of its surface, in R^3.
struct Case {
  Case(const shapes::Mesh& fine, Index vertices, const AnisotropicRemeshingOptions& chosen = {})
      : options(chosen),
        mesh(simplify_mesh(fine.vertices, fine.vertices, fine.faces, kNoPoints, kNoPoints, {.vertices = vertices}, {})),
        points(fine.faces.rows(), 3),
        normals(fine.faces.rows(), 3) {
    for (Index f = 0; f < fine.faces.rows(); ++f) {
      const Eigen::RowVector3d a = fine.vertices.row(fine.faces(f, 0)), b = fine.vertices.row(fine.faces(f, 1)),
                               c = fine.vertices.row(fine.faces(f, 2));
      points.row(f) = (a + b + c) / 3;
      normals.row(f) = (b - a).cross(c - a).normalized();
    }
    bases = tangent_bases_across(normals);
  }

  EmbeddedMesh remeshed(const Progress& progress = {}) const {
    return remesh_anisotropically(mesh.vertices, mesh.coordinates, mesh.faces, {points, bases, normals}, options,
                                  progress, fixed);
  }

  AnisotropicRemeshingOptions options;
  SimplifiedMesh mesh;
  Mask fixed;
  Coordinates points, bases;
  Points normals;
};

/// The mean of G = 2 sqrt(3) area / (half the perimeter times the longest edge) in R^d; 1 if all are equilateral.
double quality(const Coordinates& coordinates, const Faces& faces) {
  double sum = 0;
  for (Index f = 0; f < faces.rows(); ++f) {
    const Eigen::VectorXd u = coordinates.row(faces(f, 1)) - coordinates.row(faces(f, 0)),
                          v = coordinates.row(faces(f, 2)) - coordinates.row(faces(f, 0));
    const double area = std::sqrt(std::max(0.0, u.squaredNorm() * v.squaredNorm() - std::pow(u.dot(v), 2))) / 2;
    const double third = (u - v).norm();
    sum += 4 * std::sqrt(3) * area / ((u.norm() + v.norm() + third) * std::max({u.norm(), v.norm(), third}));
  }
  return sum / static_cast<double>(faces.rows());
}

/// A grid of a surface over the unit square, its vertices scattered within it.
shapes::Mesh scattered(const std::function<double(double, double)>& height, unsigned seed) {
  auto mesh = shapes::grid(40, 40);
  std::mt19937 random(seed);
  for (Index v = 0; v < mesh.vertices.rows(); ++v) {
    auto p = mesh.vertices.row(v);
    for (int i = 0; i < 2; ++i) {
      const double share = static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
      if (p(i) > 0 && p(i) < 1) p(i) += 0.01 * (share - 0.5);
    }
    p(2) = height(p(0), p(1));
  }
  return mesh;
}

double bumps(double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y); }
double roof(double x, double) { return -std::abs(x - 0.5); }

TEST(AnisotropicRemeshing, MakesTrianglesEvenAndKeepsTheTopology) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Case open(scattered(bumps, seed), 300);
    const EmbeddedMesh made = open.remeshed();
    EXPECT_GT(quality(made.vertices, made.faces), quality(open.mesh.vertices, open.mesh.faces) + 0.03);
    const MeshCheck before = check_mesh(open.mesh.vertices, open.mesh.faces),
                    after = check_mesh(made.vertices, made.faces);
    EXPECT_TRUE(after.manifold() && after.oriented());
    EXPECT_EQ(after.vertices, before.vertices);
    EXPECT_EQ(after.faces, before.faces);
    EXPECT_EQ(after.boundary_edges, before.boundary_edges);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
    EXPECT_EQ(count_self_intersections(made.vertices, made.faces), 0);
  }
  const Case closed(shapes::torus(60, 30), 300);
  const EmbeddedMesh torus = closed.remeshed();
  const MeshCheck check = check_mesh(torus.vertices, torus.faces);
  EXPECT_TRUE(check.manifold() && check.oriented() && check.closed());
  EXPECT_EQ(check.genus(), 1);
  EXPECT_GT(quality(torus.vertices, torus.faces), quality(closed.mesh.vertices, closed.mesh.faces) + 0.03);
}

TEST(AnisotropicRemeshing, StaysOnTheSurface) {
  const auto fine = shapes::torus(60, 30);
  const Case small(fine, 300);
  const EmbeddedMesh made = small.remeshed();
  const auto rms = [&](const Points& vertices, const Faces& faces) {
    const Eigen::VectorXd distance = closest_surface_points(vertices, faces, fine.vertices).distance;
    return std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size()));
  };
  EXPECT_LT(rms(made.vertices, made.faces), 1.5 * rms(small.mesh.vertices, small.mesh.faces));
}

TEST(AnisotropicRemeshing, FollowsTheEmbedding) {
  Case flat(scattered([](double, double) { return 0.0; }, 1), 200);
  flat.mesh.coordinates.col(0) *= 3;
  flat.points.col(0) *= 3;
  const EmbeddedMesh made = flat.remeshed();
  EXPECT_GT(quality(made.coordinates, made.faces), quality(flat.mesh.coordinates, flat.mesh.faces) + 0.05);
  EXPECT_GT(quality(made.coordinates, made.faces), quality(made.vertices, made.faces) + 0.1);
}

TEST(AnisotropicRemeshing, LeavesNoCrease) {
  const auto fine = scattered(roof, 2);
  const Case small(fine, 120);
  const EmbeddedMesh made = small.remeshed();
  const double spacing = std::sqrt(1.0 / 120);
  EXPECT_LT(closest_surface_points(made.vertices, made.faces, fine.vertices).distance.maxCoeff(), spacing / 4);
}

TEST(AnisotropicRemeshing, LeavesBordersAlone) {
  const Case open(scattered(bumps, 4), 300);
  const EmbeddedMesh made = open.remeshed();
  const auto on_border = [](const auto& p) { return p(0) < 1e-9 || p(0) > 1 - 1e-9 || p(1) < 1e-9 || p(1) > 1 - 1e-9; };
  for (Index v = 0; v < made.vertices.rows(); ++v) {
    if (!on_border(open.mesh.vertices.row(v))) continue;
    EXPECT_EQ(made.vertices.row(v), open.mesh.vertices.row(v));
  }
}

TEST(AnisotropicRemeshing, LeavesFixedVerticesAlone) {
  Case torus(shapes::torus(60, 30), 300);
  torus.fixed = Mask::Zero(torus.mesh.vertices.rows());
  for (Index v = 0; v < torus.fixed.size(); v += 3) torus.fixed(v) = true;
  const EmbeddedMesh made = torus.remeshed();
  Index moved = 0;
  for (Index v = 0; v < made.vertices.rows(); ++v) {
    const bool same = made.vertices.row(v) == torus.mesh.vertices.row(v);
    EXPECT_TRUE(same || !torus.fixed(v));
    moved += !same;
  }
  EXPECT_GT(moved, 100);
}

TEST(AnisotropicRemeshing, IsTheSameForAnyNumberOfThreads) {
  const Case open(scattered(bumps, 5), 300);
  const EmbeddedMesh all = open.remeshed();
  set_thread_limit(1);
  const EmbeddedMesh one = open.remeshed();
  set_thread_limit(0);
  EXPECT_EQ(all.vertices, one.vertices);
  EXPECT_EQ(all.coordinates, one.coordinates);
  EXPECT_EQ(all.faces, one.faces);
}

TEST(AnisotropicRemeshing, TakesFewPointsAndVerticesWithoutAny) {
  Case sparse(shapes::torus(30, 15), 300);
  sparse.points = sparse.points.topRows(40).eval();
  sparse.bases = sparse.bases.topRows(40).eval();
  sparse.normals = sparse.normals.topRows(40).eval();
  const EmbeddedMesh made = sparse.remeshed();
  EXPECT_TRUE(made.vertices.allFinite() && made.coordinates.allFinite());
  EXPECT_TRUE(check_mesh(made.vertices, made.faces).closed());
}

TEST(AnisotropicRemeshing, RefusesBrokenInput) {
  const Case good(scattered(bumps, 6), 100);
  Case broken = good;
  broken.points(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
  broken = good;
  broken.bases.conservativeResize(broken.bases.rows(), 4);
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
  broken = good;
  broken.normals.conservativeResize(3, 3);
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
  broken = good;
  broken.mesh.coordinates.conservativeResize(3, 3);
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
  broken = good;
  broken.mesh.faces.row(0) = broken.mesh.faces.row(0).reverse().eval();
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
  broken = good;
  broken.fixed = Mask::Zero(3);
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
  broken = good;
  broken.options.pull = 0;
  EXPECT_THROW(broken.remeshed(), InvalidArgument);
}

TEST(AnisotropicRemeshing, CanBeCancelledHalfway) {
  const Case open(scattered(bumps, 7), 200);
  double seen = 0;
  const auto stop_halfway = [&](double fraction) {
    seen = fraction;
    return fraction < 0.5;
  };
  EXPECT_THROW(open.remeshed(stop_halfway), Cancelled);
  EXPECT_LT(seen, 0.6);
}

}  // namespace
}  // namespace hdpea
