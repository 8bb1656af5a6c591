// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/mesh/hole_filling.hpp"

namespace hdpea {

/// Closes the long narrow gaps that cells leave along the rims of thin walls, and that are no holes to fill_holes:
/// their loops wind through both sides and come near themselves, or two of them run along each other around the whole
/// rim.
///
/// Of all triangulations of a loop whose edges the mesh does not have yet, the one with the least area is taken, where
/// a face that turns away from the normals of its corners counts up to three times (Barequet and Sharir 1995). Two
/// loops that are nowhere farther apart than `max_size` are joined by two faces first. A patch is left out if its size,
/// 4 area / perimeter, is more than `max_size`, or if it faces against the normals, as one does that closes an outer
/// border by folding back over the mesh. Loops of more than 500 edges stay open.
///
/// @param vertices  (v, 3)
/// @param faces     (f, 3) edge- and vertex-manifold, oriented as the normals
/// @param normals   (v, 3) unit, of the surface at the vertices
/// @param max_size  >= 0
/// @returns the mesh, its patches last; no vertex is added. `filled` and `left` count loops
/// @throws InvalidArgument on a broken contract
FilledMesh close_gaps(const PointsRef& vertices, const FacesRef& faces, const PointsRef& normals, double max_size);

}  // namespace hdpea
