// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/changes_taken_back.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

/// The grid without the face that has a point, and that far from it without another one.
struct Case {
  Case() : grid(shapes::grid(8, 8)), point(1, 3), changed{grid.vertices, Faces(grid.faces.rows() - 2, 3)} {
    point.row(0) = centroid(kGone);
    Index row = 0;
    for (Index f = 0; f < grid.faces.rows(); ++f) {
      if (f != kGone && f != kElsewhere) changed.faces.row(row++) = grid.faces.row(f);
    }
  }

  Eigen::RowVector3d centroid(Index f) const { return grid.vertices(grid.faces.row(f), Eigen::all).colwise().mean(); }

  TriangleMesh without_losses(double farthest) const {
    return with_losses_taken_back(grid.vertices, grid.faces, changed, point, farthest);
  }

  static constexpr Index kGone = 20, kElsewhere = 100;
  shapes::Mesh grid;
  Points point;
  TriangleMesh changed;
};

bool has_face_at(const TriangleMesh& mesh, const Eigen::RowVector3d& centroid) {
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3d middle = mesh.vertices(mesh.faces.row(f), Eigen::all).colwise().mean();
    if ((middle - centroid).norm() < 1e-12) return true;
  }
  return false;
}

TEST(ChangesTakenBack, OnlyWhatLostAPointComesBack) {
  const Case c;
  const TriangleMesh mesh = c.without_losses(0.01);
  EXPECT_EQ(mesh.faces.rows(), c.grid.faces.rows() - 1);
  EXPECT_TRUE(has_face_at(mesh, c.centroid(Case::kGone)));
  EXPECT_FALSE(has_face_at(mesh, c.centroid(Case::kElsewhere)));
}

TEST(ChangesTakenBack, WhatIsNearEnoughIsNotLost) {
  const Case c;
  EXPECT_EQ(c.without_losses(1).faces.rows(), c.changed.faces.rows());
}

TEST(ChangesTakenBack, AVertexThatWasMovedGoesBack) {
  Case c;
  c.changed = {c.grid.vertices, c.grid.faces};
  c.changed.vertices.row(c.grid.faces(Case::kGone, 0)) += Eigen::RowVector3d(0, 0, 1);
  const TriangleMesh mesh = c.without_losses(0.01);
  EXPECT_EQ(mesh.vertices.rows(), c.grid.vertices.rows());
  EXPECT_EQ(mesh.vertices.col(2).cwiseAbs().maxCoeff(), 0);
}

}  // namespace
}  // namespace hdpea
