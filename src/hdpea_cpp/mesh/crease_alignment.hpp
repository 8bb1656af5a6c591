// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/points/creases.hpp"

namespace hdpea {

/// Moves vertices onto creases and flips edges, so that no edge runs across a crease.
///
/// Of every edge with its ends on the two sides of a crease, the nearer end moves onto it, or the edge is flipped if
/// the vertices opposite to it lie there; what is left between the sides are edges along the crease. This is how
/// extended marching cubes align a mesh (Kobbelt, Botsch, Schwanecke and Seidel 2001), without new vertices. A vertex
/// moves less than the edges at it are long, and hardly farther than the points are apart. A move or a flip that would
/// turn a face over is not made, so an edge across a crease may stay. The topology stays.
///
/// @param vertices  (v, 3)
/// @param faces     (f, 3) edge- and vertex-manifold, oriented as the normals of the creases
/// @param fixed     (v) vertices that stay where they are, or empty: none
/// @throws InvalidArgument on a broken contract
TriangleMesh align_to_creases(const PointsRef& vertices, const FacesRef& faces, const Creases& creases,
                              const MaskRef& fixed = Mask());

}  // namespace hdpea
