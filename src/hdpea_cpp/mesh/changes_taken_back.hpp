// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Takes back the changes of a mesh that lost points of the surface it was made from.
///
/// A change is a set of faces that are gone, or new, and share corners; beyond them the two meshes are the same, so
/// each change can be taken back by itself. It has lost points if one that was nearest to a face that is gone is
/// farther from the changed mesh than `farthest`, and than all of those were from the given one.
///
/// @param vertices  (v, 3)
/// @param faces     (f, 3)
/// @param changed   in which vertices that stayed are where they were, to the last bit
/// @param points    (n, 3), n >= 0
/// @returns the changed mesh, with the faces of those changes as they were; no vertex is without a face. Where two of
/// the
///          vertices lie in one place, it may not be a manifold
TriangleMesh with_losses_taken_back(const PointsRef& vertices, const FacesRef& faces, const TriangleMesh& changed,
                                    const PointsRef& points, double farthest);

}  // namespace hdpea
