// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// When to stop simplifying: as soon as the mesh has no more vertices and no more faces than these.
struct MeshBudget {
  Index vertices = std::numeric_limits<Index>::max();
  Index faces = std::numeric_limits<Index>::max();
};

/// What an edge collapse costs.
struct SimplificationOptions {
  double evenness = 1e-3;  ///< cost of a squared distance in R^d, where one in R^3 costs 1
  double border = 1;       ///< weight of the planes that hold borders in place, where those of faces have 1
  double pull = 1e-3;      ///< weight of the middle of the edge, as a share of the planes

  /// Where an error is to be kept, flat parts need no vertices: evenness only chooses among collapses that cost
  /// nothing.
  static SimplificationOptions within_error() { return {.evenness = 1e-7}; }
};

struct SimplifiedMesh {
  Points vertices;          ///< (v, 3)
  Coordinates coordinates;  ///< (v, d) the centroids of the parts that they represent
  Faces faces;              ///< (f, 3)
};

/// Collapses edges until a mesh is small enough, the cheapest first.
///
/// A vertex represents the part of the given surface that has been collapsed into it. A collapse costs the squared
/// distance of the new vertex from the planes of its part (quadrics, weighted by area; Garland and Heckbert 1997),
/// which keeps creases, plus a weight times the growth of the part's variance under the metric of R^d (Ward 1963):
/// evenly spread particles minimise this energy, and it keeps triangles aligned with curvature. The planes are the
/// tangent planes of the points, or, where there are none, of the faces. The topology stays; a collapse that would flip
/// a face is not made, so a budget may be out of reach.
///
/// @param vertices     (v, 3)
/// @param coordinates  (v, d) of the vertices in the embedding
/// @param faces        (f, 3) edge- and vertex-manifold, oriented
/// @param points       (n, 3), n >= 0
/// @param normals      (n, 3) unit
/// @param fixed        (v) vertices that stay where they are, or empty: none
/// @throws InvalidArgument on a broken contract; Cancelled
SimplifiedMesh simplify_mesh(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                             const PointsRef& points, const PointsRef& normals, const MeshBudget& budget,
                             const SimplificationOptions& options, const Progress& progress = {},
                             const MaskRef& fixed = Mask());

/// Collapses edges as long as the mesh stays within an error of the points, both ways.
///
/// Every point lies within the error of the mesh, and every place of the mesh within the error of the disk of one of
/// its 24 nearest points that faces as it does: of what lies across its normal, out to its radius. What is farther at
/// first may not get farther; when no edge can be collapsed any more, faces that still are too far from points are
/// split at these, and it goes on.
/// Even so some may be out of reach: a tip without mesh, noise wider than the error.
///
/// @param radii  (n) of the points' disks
/// @param error  > 0
/// Else as simplify_mesh.
SimplifiedMesh simplify_within(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                               const PointsRef& points, const PointsRef& normals,
                               const Eigen::Ref<const Eigen::VectorXd>& radii, double error,
                               const SimplificationOptions& options, const Progress& progress = {});

}  // namespace hdpea
