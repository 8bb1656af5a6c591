// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/mesh/flippable_mesh.hpp"

namespace hdpea {

/// A manifold triangle mesh whose vertices can be moved and edges flipped, but for what would turn a face over or
/// squash it.
class GuardedMesh {
 public:
  /// @param vertices  (v, 3)
  /// @param faces     (f, 3) edge- and vertex-manifold, oriented
  GuardedMesh(const PointsRef& vertices, const FacesRef& faces)
      : vertices_(vertices), topology_(faces, vertices.rows()) {}

  const Points& vertices() const { return vertices_; }
  const FlippableMesh& topology() const { return topology_; }
  Eigen::RowVector3d at(Index v) const { return vertices_.row(v); }
  /// Across a face, twice its area long.
  Eigen::RowVector3d area(Index f) const;
  /// The mean length (v) of the edges at each vertex.
  Eigen::VectorXd mean_lengths() const;

  /// Moves a vertex; false, and nothing done, if a face at it would turn by about a right angle or more, or keep less
  /// than a twentieth of its area.
  bool move(Index v, const Eigen::RowVector3d& to);
  /// Flips an edge; false, and nothing done, if a new face would be turned by about a right angle or more from those
  /// before, or be flat, or if topology does not allow it. It is of an inner edge.
  bool flip(Index h);

 private:
  Points vertices_;
  FlippableMesh topology_;
};

}  // namespace hdpea
