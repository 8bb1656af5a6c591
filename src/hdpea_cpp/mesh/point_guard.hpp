// SPDX-License-Identifier: GPL-3.0-or-later
// For the sources of remeshing; not installed.
#pragma once

#include <span>

#include "hdpea_cpp/mesh/cgal_mesh.hpp"
#include "hdpea_cpp/mesh/vertex_cells.hpp"

namespace hdpea {

/// Tells whether a step of remeshing harms: how far it takes the points of its vertices from the faces around these,
/// and how it turns the faces. It looks at a mesh, positions and cells that others change.
class PointGuard {
 public:
  using Vertex = SurfaceMesh::Vertex_index;

  /// Of points from the faces around their vertices.
  struct SquaredDistances {
    double sum = 0, largest = 0;
    bool within(const SquaredDistances& most) const { return sum <= most.sum && largest <= most.largest; }
  };

  /// @param positions  (v, 3) of the vertices
  PointGuard(const SurfaceMesh& mesh, const Points& positions, const VertexCells& cells, const EmbeddedCloud& cloud);

  SquaredDistances squared_distances(std::span<const Vertex> vertices) const;
  /// The most that squared_distances may be after a step.
  SquaredDistances allowed(std::span<const Vertex> vertices) const;
  /// Whether a point is near enough to the faces around a vertex to belong to it.
  bool may_cover(Index point, Vertex v) const;

  /// Whether a face abc may take the place of one of such uprightness; of a vertex's faces the least counts.
  static bool stays_upright(double uprightness, double before);
  /// The cosine between a face and the mean normal of its corners' points; 1 if these have none.
  double uprightness(Vertex a, Vertex b, Vertex c) const;
  /// The least of the faces around a vertex.
  double uprightness(Vertex v) const;
  Eigen::RowVector3d unit_normal(Vertex a, Vertex b, Vertex c) const;
  double area(SurfaceMesh::Face_index face) const;

 private:
  double squared_distance_from_ring(Index point, Vertex v) const;
  double area() const;

  const SurfaceMesh& mesh_;
  const Points& positions_;
  const VertexCells& cells_;
  const EmbeddedCloud& cloud_;
  double together_ = 0, alone_ = 0;  // the squared distance that points of a vertex may have on average, and one
};

}  // namespace hdpea
