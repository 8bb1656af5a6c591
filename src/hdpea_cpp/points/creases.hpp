// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// What counts as a crease. Spacings are local ones: the square root of the area per point.
struct CreaseOptions {
  Index neighbors = 32;       ///< points that two planes are fitted to
  double min_angle = 40;      ///< degrees between the normals of the two planes
  double max_residual = 0.3;  ///< variance off the two planes, as a share of that off a quadratic surface
  double min_length = 8;      ///< of a line of creases, in spacings
};

/// Places on the sharp edges that points show, about two to a spacing.
struct Creases {
  Points positions;       ///< (m, 3)
  Points directions;      ///< (m, 3) unit, along the crease, of either sign
  Points first_normals;   ///< (m, 3) unit, of the plane on one side of the crease, out of the surface
  Points second_normals;  ///< (m, 3) unit, of the plane on the other
  Eigen::VectorXd spacings;  ///< (m) of the points there
  Points corners;         ///< (c, 3) where three planes meet
};

Creases find_creases(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options);

}  // namespace hdpea
