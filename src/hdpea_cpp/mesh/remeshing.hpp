// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// How a mesh is remeshed. The edge length is in the unit of the vertices.
struct RemeshingOptions {
  double edge_length = 0.0075;  ///< of the triangles to be made, > 0
  double sharp_angle = 40;      ///< degrees between two faces from which their edge is kept; of a border, its corner
  Index iterations = 5;         ///< rounds of splits, collapses, flips and relaxation
};

/// Covers the same surface with near-isotropic triangles, by CGAL (Botsch & Kobbelt 2004).
///
/// Sharp edges and borders stay where they are, everything else is relaxed and projected back on the given surface.
/// Faces may be needles. Vertices where sheets touch (pinched ones) are split, vertices that differ by rounding errors
/// only are joined, vertices without a face left out.
///
/// @param vertices  (n, 3), finite
/// @param faces     (f, 3) indices into vertices, consistently oriented, at most two to an edge
/// @throws InvalidArgument on a broken contract; CannotReconstruct if vertices lie in one place and cannot be joined
TriangleMesh remesh_isotropically(const PointsRef& vertices, const FacesRef& faces, const RemeshingOptions& options);

}  // namespace hdpea
