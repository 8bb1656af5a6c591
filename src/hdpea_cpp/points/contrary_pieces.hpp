// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Turns pieces of the surface whose normals the winding number of all others contradicts.
///
/// A piece is a set of points connected by edges along which normals, carried as by `orient_normals`, agree: what was
/// seen through an opening touches nothing else. The winding number falls from the inside to the outside, also that of
/// the rest of the surface alone, and so along the normals of every piece of it (Metzer et al., "Orienting point clouds
/// with dipole propagation", 2021, with pieces for patches). Where it rises at most samples of a piece, this is turned,
/// that first along which it rises most. The largest stays.
///
/// @param points     (n, 3), finite
/// @param normals    (n, 3) unit, mostly oriented
/// @param neighbors  (n, k), -1 pads
Points turn_contrary_pieces(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors);

}  // namespace hdpea
