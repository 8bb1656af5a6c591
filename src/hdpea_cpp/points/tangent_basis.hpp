// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Orthonormal bases of the tangent planes of an embedded surface [p, psi(p)] in R^d.
///
/// The plane of p in R^3 is known from its normal; psi is fitted on it as an affine map, by weighted least squares
/// over the neighbours, and the tangent plane is the graph of that map. HD-PEA takes PCA in R^d (section 3.2),
/// which on thin parts, where the neighbours reach around a strut, finds the plane of the reach instead.
///
/// Give the neighbours *in R^3*, of the same sheet (the ablation of HD-PEA: they keep the topology where
/// neighbours in R^d jump between folds).
///
/// @param coordinates  (n, d), d >= 3, the first three the positions
/// @param normals      (n, 3) unit
/// @param neighbors    (n, k) indices, -1 pads
/// @returns (n, 2 d): the two basis vectors of a point one after the other
Coordinates tangent_bases(const CoordinatesRef& coordinates, const PointsRef& normals, const NeighborsRef& neighbors);

/// The same for a surface in R^3: any basis of the plane across the normal.
Coordinates tangent_bases_across(const PointsRef& normals);

}  // namespace hdpea
