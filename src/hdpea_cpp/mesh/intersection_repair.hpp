// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A mesh, and how many pairs of its faces cut each other.
struct RepairedMesh {
  Points vertices;
  Faces faces;
  Index self_intersections = 0;  ///< as count_self_intersections has them
};

/// Mends faces that cut or touch others: what folds over itself is smoothed, or else cut out and triangulated anew.
///
/// By CGAL's remove_self_intersections, in small neighbourhoods only: where two walls pass through each other, larger
/// ones take away more than they mend. What even so loses points of the surface is taken back
/// (with_losses_taken_back), so such places may stay. A mesh in which no face cuts another, or which would
/// have no fewer that do, is returned as it is. Borders stay; a handle may go, a vertex may go or move.
///
/// @param vertices  (v, 3), finite
/// @param faces     (f, 3) edge- and vertex-manifold, oriented; what is returned is so, too
/// @param points    (n, 3) of the surface, n >= 0
/// @param farthest  that a point may get from the mesh in a mended place, if none there was as far; infinity: however
/// far
/// @throws InvalidArgument on a broken contract
RepairedMesh repair_self_intersections(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points,
                                       double farthest);

}  // namespace hdpea
