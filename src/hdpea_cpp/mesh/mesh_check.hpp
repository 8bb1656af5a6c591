// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// What a mesh is, in counts. Faces that repeat an index count as degenerate and as nothing else.
struct MeshCheck {
  Index vertices = 0;
  Index faces = 0;
  Index edges = 0;
  /// Edges of one face.
  Index boundary_edges = 0;
  /// Edges of three faces or more.
  Index nonmanifold_edges = 0;
  /// Vertices whose link is not one path or one cycle; the ends of nonmanifold edges are among them.
  Index nonmanifold_vertices = 0;
  /// Edges that both their faces traverse in the same direction.
  Index inconsistent_edges = 0;
  /// Faces that repeat an index, or whose corners lie exactly on a line.
  Index degenerate_faces = 0;
  Index repeated_index_faces = 0;
  /// Faces with the corners of an earlier one, in any order.
  Index duplicate_faces = 0;
  Index unreferenced_vertices = 0;
  /// As if vertices of several fans were split into one vertex for each.
  Index boundary_loops = 0;
  /// Sets of faces connected across edges.
  Index components = 0;
  /// Vertices of faces - edges + faces.
  Index euler_characteristic = 0;

  /// Every vertex has a disk or a half-disk around it, and no face is a copy of another.
  bool manifold() const {
    return nonmanifold_edges + nonmanifold_vertices + duplicate_faces + repeated_index_faces == 0;
  }
  bool oriented() const { return inconsistent_edges == 0; }
  /// A surface without boundary.
  bool closed() const { return faces > 0 && boundary_edges == 0; }
  /// Handles of all components together; none unless manifold and oriented.
  std::optional<Index> genus() const;
};

/// Counts the defects and the topology of a triangle mesh; never changes it.
///
/// @param vertices  (n, 3), finite
/// @param faces     (f, 3) indices into vertices
/// @throws InvalidArgument if an index is out of range or a vertex is not finite
MeshCheck check_mesh(const PointsRef& vertices, const FacesRef& faces);

}  // namespace hdpea
