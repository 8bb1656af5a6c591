// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Principal curvatures and directions at each point of an oriented cloud.
struct Curvature {
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> principal;  ///< (n, 2) k1, k2 with |k1| >= |k2|, 1 / length
  Points direction1;  ///< (n, 3) unit tangent of k1; that of k2 is normal x direction1
};

/// Fits the shape operator W to the change of the normals around each point, dn = W dx, by weighted least squares.
///
/// Weights are exp(-2 |dx|^2 / radius^2), so curvature is measured at the length `radius` whatever the
/// sampling; a crease becomes a large but finite curvature across itself. Convex shapes with outward
/// normals have positive curvatures.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit, consistently oriented
/// @param neighbors  (n, k) of the same sheet, -1 pads; those beyond `radius` count for nothing unless
///                   fewer than 6 are nearer
/// @param radius     > 0, same unit as the points
Curvature estimate_curvature(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                             double radius);

}  // namespace hdpea
