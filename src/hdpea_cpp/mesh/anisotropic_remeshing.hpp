// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/mesh/vertex_cells.hpp"

namespace hdpea {

/// How a mesh is made even in its embedding.
struct AnisotropicRemeshingOptions {
  Index rounds = 12;         ///< of flips and relaxation
  Index valence_rounds = 6;  ///< the first of them, whose flips aim at six edges to a vertex
  double step = 0.9;         ///< share of the way to the middle of the ring that a vertex goes in a round
  double pull = 0.15;        ///< what a squared distance from there costs, where one from the points' planes costs 1
};

/// A mesh of an embedded surface.
struct EmbeddedMesh {
  Points vertices;          ///< (v, 3)
  Coordinates coordinates;  ///< (v, d) on the embedded surface
  Faces faces;              ///< (f, 3)
};

/// Makes the triangles of a mesh as equilateral in R^d as can be, without leaving the points it was made from.
///
/// In turn, edges are flipped (Botsch and Kobbelt 2004: first for six edges to a vertex, then for the Delaunay
/// condition, both by the angles in R^d), and every vertex goes towards the centroid in R^d of the faces around it,
/// back onto the tangent plane of the nearest point there, and as far as the tangent planes in R^3 of the points that
/// it stands for let it: at a crease these hold it, along the crease or on a flat part they do not.
///
/// What would harm is not done. Neither a move nor a flip may take the points of the vertices concerned farther from
/// the faces around these than they are, or than twice what points are on average before the first round (once, where
/// that is much), nor a single point farther than it is, or than 5.5 times that average; nor may it turn a face away
/// from its points; nor may a vertex move farther from the points around it than it is, or than they are apart, unless
/// the surface ends there. Vertices on borders and those that are fixed do not move. So the topology, the numbers and
/// the order of vertices and faces stay.
///
/// @param vertices     (v, 3)
/// @param coordinates  (v, d) of the vertices in the embedding, near the surface
/// @param faces        (f, 3) edge- and vertex-manifold, oriented as the normals
/// @param fixed        (v) vertices that stay where they are, or empty: none
/// @throws InvalidArgument on a broken contract; Cancelled
EmbeddedMesh remesh_anisotropically(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                                    const EmbeddedCloud& cloud, const AnisotropicRemeshingOptions& options,
                                    const Progress& progress = {}, const MaskRef& fixed = Mask());

}  // namespace hdpea
