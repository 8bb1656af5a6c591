// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Which neighbours count how much.
struct MovingLeastSquaresOptions {
  double reach = 0.5;      ///< share of the farthest neighbour's distance at which a weight has fallen to 1 / e
  double agreement = 0.5;  ///< distance of unit normals at which a weight has fallen to 1 / e: edges stay
};

/// Places on the surface that points sample.
struct SurfacePlaces {
  Points points;   ///< (n, 3)
  Points normals;  ///< (n, 3) unit, of the fitted surface, on the side of the given normals
};

/// Moves places near a cloud along their normals onto the quadric that fits the cloud there.
///
/// Moving least squares (Alexa et al., Computing and Rendering Point Set Surfaces, 2003), with weights that
/// fall with the difference of the normals too (Oztireli et al., Feature Preserving Point Set Surfaces, 2009).
///
/// Along its normal, a place stays in the range of the points that it is fitted to, widened by a quarter at either end.
///
/// @param places     (n, 3) one near each point: at first the points themselves, then the result of an earlier call
/// @param normals    (n, 3) unit, consistently oriented, at the places
/// @param points     (n, 3) what is fitted
/// @param neighbors  (n, k) of each point, -1 pads; the point itself counts as well
SurfacePlaces moving_least_squares(const PointsRef& places, const PointsRef& normals, const PointsRef& points,
                                   const NeighborsRef& neighbors, const MovingLeastSquaresOptions& options = {});

}  // namespace hdpea
