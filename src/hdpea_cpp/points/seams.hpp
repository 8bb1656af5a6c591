// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Turns what goes on smoothly beyond a line, with the opposite normals.
///
/// Where the end of a scan overlaps its beginning and does not meet it, the two layers look like the sides of a thin
/// wall, and one of them gets the wrong side. Unlike a wall, it is torn at both ends from what it is part of: there,
/// points lie in the planes of points beyond, whose normals are opposite, and those on this side agree. Of two pieces
/// along such a line, if it is long, the smaller is turned. The two faces of a wall thinner than the points
/// are apart, whose points also lie in each other's planes, are mixed rather than beside each other.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit, mostly oriented
/// @param neighbors  (n, k), -1 pads
Points turn_at_seams(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors);

}  // namespace hdpea
