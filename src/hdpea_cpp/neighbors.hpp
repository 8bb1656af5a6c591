// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/types.hpp"

namespace hdpea {

/// The k nearest of `points` to each of `queries`, in R^d.
///
/// Rows are sorted by (distance, index), so equal distances cannot make the result depend on the
/// order of a tree. A query that is itself one of the points finds itself first (or an earlier duplicate).
///
/// @param points   (n, d), n >= 1, finite
/// @param queries  (m, d), finite
/// @param k        how many; rows are padded with -1 where n < k
/// @throws InvalidArgument if k < 1, n < 1 or the dimensions differ
Neighbors nearest_neighbors(const CoordinatesRef& points, const CoordinatesRef& queries, Index k);

/// The k nearest *other* points of each point: as above, without the point itself.
Neighbors nearest_neighbors(const CoordinatesRef& points, Index k);

/// Keeps, of each row, the neighbours on the same sheet: those whose normal agrees with the point's.
///
/// Two sides of a thin wall are near in space but have opposite normals; one neighbour from the other
/// side ruins a tangent plane or a curvature. Order is kept; rows are filled up with -1.
///
/// @param neighbors   (n, k) indices into the points, -1 allowed
/// @param normals     (n, 3) unit, consistently oriented
/// @param min_cosine  least n . n' for "agrees"
Neighbors same_sheet_neighbors(const NeighborsRef& neighbors, const PointsRef& normals, double min_cosine);

}  // namespace hdpea
