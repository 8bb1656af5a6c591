// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Gives normals one consistent orientation; their signs on entry do not matter.
///
/// Kruskal's spanning forest of the neighbour graph carries the orientation from point to point. Along an
/// edge e, a normal is reflected in the plane that bisects the edge, n - 2 (n . e) e, as it is along a circular
/// arc between the points: that is right across a sharp crease and a thin wall alike (Koenig & Gumhold 2009).
/// Edges go first where the reflected normal and the neighbour's are most nearly parallel. Each connected
/// piece then faces outwards: the volume within its points is positive. Open and rather flat, it has no inside, and
/// faces up, or the positive way along the axis that it faces most.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit
/// @param neighbors  (n, k), -1 pads
/// @param known      (n) whose signs are right on entry: these are kept, and all that is connected to them follows;
///                   or none
Points orient_normals(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                      const MaskRef& known = Mask());

/// Lets the points of one sheet vote on its signs: each piece of the surface takes the sides that most of its normals
/// have on entry.
///
/// A piece is a set of points connected by edges along which normals, carried as above, agree to within the angle of
/// `least_cosine`: it extends across creases, but not between sheets that the points do not resolve, nor far
/// through noise. Ties are decided by the side of the piece's first point.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit, mostly oriented
/// @param neighbors  (n, k), -1 pads
Points agree_on_signs(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                      double least_cosine = 0.9995);

/// Share of neighbours whose signs agree by the same criterion: 1 for oriented normals, 0.5 for random signs.
///
/// Pairs whose reflected normals are not nearly parallel (|cos| <= 0.8) are inconclusive and left out; 1 if
/// there are no others.
double orientation_consistency(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors);

}  // namespace hdpea
