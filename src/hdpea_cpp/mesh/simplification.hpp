// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// When to stop simplifying: as soon as the mesh has no more vertices and no more faces than these.
struct MeshBudget {
  Index vertices = std::numeric_limits<Index>::max();
  Index faces = std::numeric_limits<Index>::max();
};

/// What an edge collapse costs.
struct SimplificationOptions {
  double evenness = 1e-3;  ///< cost of a squared distance in R^d, where one in R^3 costs 1
  double border = 1;       ///< weight of the planes that hold borders in place, where those of faces have 1
};

struct SimplifiedMesh {
  Points vertices;          ///< (v, 3)
  Coordinates coordinates;  ///< (v, d) the centroids of the parts that they represent
  Faces faces;              ///< (f, 3)
};

/// Collapses edges until a mesh is small enough, the cheapest first.
///
/// A vertex represents the part of the given surface that has been collapsed into it. A collapse costs the squared
/// distance of the new vertex from the planes of its part (area-weighted quadrics; Garland and Heckbert 1997), which
/// keeps creases, plus a weight times the growth of the part's variance under the metric of R^d (Ward 1963): evenly
/// spread particles minimise this energy, and it keeps triangles aligned with curvature. The topology stays; a
/// collapse that would flip a face is not made, so a budget may be out of reach.
///
/// @param vertices     (v, 3)
/// @param coordinates  (v, d) of the vertices in the embedding
/// @param faces        (f, 3) edge- and vertex-manifold, oriented
/// @throws InvalidArgument on a broken contract; Cancelled
SimplifiedMesh simplify_mesh(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                             const MeshBudget& budget, const SimplificationOptions& options,
                             const Progress& progress = {});

}  // namespace hdpea
