// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/types.hpp"

namespace hdpea {

/// Orthonormal bases of the tangent planes of a surface in R^d, by PCA of each point and its neighbours.
///
/// Give the neighbours *in R^3*, of the same sheet (paper, section 3.2 and its ablation: they keep the
/// topology where neighbours in R^d jump between folds).
///
/// @param coordinates  (n, d), d >= 2
/// @param neighbors    (n, k) indices, -1 pads
/// @returns (n, 2 d): the two basis vectors of a point one after the other; coordinate axes complete a
///          neighbourhood that has no plane of its own
Coordinates tangent_bases(const CoordinatesRef& coordinates, const NeighborsRef& neighbors);

/// The same for a surface in R^3 with known unit normals: any basis of the plane across the normal.
Coordinates tangent_bases_across(const PointsRef& normals);

}  // namespace hdpea
