// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/types.hpp"

namespace hdpea {

/// Unoriented unit normals by PCA of each point's neighbours.
///
/// A second pass weighs the neighbours by how well they lie in the first pass's plane, so that planes near
/// a crease are not averaged across it.
///
/// @param points     (n, 3)
/// @param neighbors  (n, k) nearest first, -1 pads
/// @returns (n, 3); a point without a plane of its own gets some unit vector, always the same
Points estimate_normals(const PointsRef& points, const NeighborsRef& neighbors);

/// Gives normals one consistent orientation; their signs on entry do not matter.
///
/// Kruskal's spanning forest of the neighbour graph carries the orientation from point to point. Along an
/// edge e, a normal is reflected in the plane that bisects the edge, n - 2 (n . e) e, as it is along a circular
/// arc between the points: that is right across a sharp crease and a thin wall alike (Koenig & Gumhold 2009).
/// Edges go first where the reflected normal and the neighbour's are most nearly parallel. Each connected
/// piece then faces outwards at its extreme points.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit
/// @param neighbors  (n, k), -1 pads
Points orient_normals(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors);

/// Share of neighbours whose signs agree by the same criterion: 1 for oriented normals, 0.5 for random signs.
///
/// Pairs whose reflected normals are not nearly parallel (|cos| <= 0.8) say nothing and are left out; 1 if
/// there are no others.
double orientation_consistency(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors);

}  // namespace hdpea
