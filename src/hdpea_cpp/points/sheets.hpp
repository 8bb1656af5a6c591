// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// When two nearby points lie on the same sheet of the surface.
struct SheetOptions {
  double min_cosine = -0.2;   ///< least n . n' of neighbours on one sheet: a right angle is still one sheet
  double max_slope = 0.7;     ///< sine of the steepest slope to a neighbour farther away than rim_distance
  double rim_gap = 150;       ///< degrees without a neighbour that make a point the rim of its sheet
  double rim_distance = 1.5;  ///< sheets meet at their rims within this many distances of the 3rd neighbour
};

/// Keeps, of each row, the neighbours on the same sheet.
///
/// The two sides of a thin wall are near in space but not along the surface, and one neighbour from the
/// other side ruins a tangent plane or a curvature: neighbours whose normals disagree are left out, and so
/// are those of a parallel sheet, which lie above or below rather than beside the point. The two
/// sides of a knife's edge disagree as well but do meet: there both points are rims of their sheets (their
/// own sheet's neighbours leave a wide gap around them), and neighbours of each other are kept.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit, consistently oriented
/// @param neighbors  (n, k) nearest first, -1 pads
/// @returns (n, k) in the same order, filled up with -1
Neighbors sheet_neighbors(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                          const SheetOptions& options = {});

/// The mean normal of each point and its `count` nearest neighbours of the sheet.
///
/// Across a crease or a knife's edge it looks out along the bisector, so both sides can be seen (projected)
/// without folding over; where the surface is smooth it is the normal.
Points blended_normals(const PointsRef& normals, const NeighborsRef& sheet_neighbors, Index count = 8);

}  // namespace hdpea
