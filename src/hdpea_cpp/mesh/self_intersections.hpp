// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// How many pairs of faces cut or touch each other in more than the vertices and edges they share.
///
/// Decided by exact predicates. Sharing is by index: two vertices at one place count as touching.
/// Faces whose corners lie on a line are left out.
///
/// @param vertices  (n, 3), finite
/// @param faces     (f, 3) indices into vertices; need not be manifold
/// @throws InvalidArgument if an index is out of range or a vertex is not finite
Index count_self_intersections(const PointsRef& vertices, const FacesRef& faces);

}  // namespace hdpea
