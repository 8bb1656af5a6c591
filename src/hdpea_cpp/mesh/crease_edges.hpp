// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/points/creases.hpp"

namespace hdpea {

/// The edges of a mesh that run along creases, with 30 degrees or more between their faces.
///
/// @param faces  (f, 3) edge- and vertex-manifold, oriented
/// @returns (k, 2) vertices
/// @throws InvalidArgument on a broken contract
Edges crease_edges(const PointsRef& vertices, const FacesRef& faces, const Creases& creases);

}  // namespace hdpea
