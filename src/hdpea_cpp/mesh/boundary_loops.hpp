// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Vertices in the order in which the faces of a patch run along them: the mesh has the edge from each back to the
/// last.
using Loop = std::vector<Index>;

/// The boundary loops of a mesh, each from its smallest vertex on, and in the order of those.
///
/// @param faces     (f, 3) edge-manifold, oriented
/// @param vertices  how many there are
/// @param has_edge  whether a face has an edge from one vertex to another
/// @throws InvalidArgument if the border touches itself at a vertex
std::vector<Loop> boundary_loops(const FacesRef& faces, Index vertices,
                                 const std::function<bool(Index, Index)>& has_edge);

/// How long a loop of the vertices (v, 3) is.
double perimeter(const PointsRef& vertices, const Loop& loop);

/// The length of a loop's vector area: no patch is smaller.
double vector_area(const PointsRef& vertices, const Loop& loop);

}  // namespace hdpea
