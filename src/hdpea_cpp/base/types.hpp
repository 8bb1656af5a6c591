// SPDX-License-Identifier: GPL-3.0-or-later
// The array types of the core. All are row-major: one row is one point, one face or one neighbourhood.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>

namespace hdpea {

using Index = std::int64_t;

/// (n, 3) positions or unit vectors in R^3.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// (n, d) coordinates in R^d, any d; d = 8 for embeddings.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// (f, 3) vertex indices, counter-clockwise seen from outside.
using Faces = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// (k, 2) the vertices of edges.
using Edges = Eigen::Matrix<Index, Eigen::Dynamic, 2, Eigen::RowMajor>;
/// (n, k) indices of neighbours, nearest first; -1 pads a row that has fewer than k.
using Neighbors = Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (n) which of the points.
using Mask = Eigen::Vector<bool, Eigen::Dynamic>;

using PointsRef = Eigen::Ref<const Points>;
using CoordinatesRef = Eigen::Ref<const Coordinates>;
using FacesRef = Eigen::Ref<const Faces>;
using NeighborsRef = Eigen::Ref<const Neighbors>;
using MaskRef = Eigen::Ref<const Mask>;

/// A triangle mesh.
struct TriangleMesh {
  Points vertices;  ///< (v, 3)
  Faces faces;      ///< (f, 3)
};

/// Called with the fraction done, in [0, 1]; returning false cancels (throws Cancelled).
using Progress = std::function<bool(double)>;

}  // namespace hdpea
