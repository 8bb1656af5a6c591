// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

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

}  // namespace hdpea
