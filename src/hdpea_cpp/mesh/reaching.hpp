// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A mesh that was drawn to points it had missed.
struct ReachedMesh {
  Points vertices;                               ///< (v + k, 3) the given ones, of which some may have moved; new ones
  Faces faces;                                   ///< (f, 3)
  Eigen::Vector<Index, Eigen::Dynamic> reached;  ///< (k) the point that each new vertex lies at
};

/// Draws a mesh to the points that are far from it, such as those of tips and rims that no cell covered.
///
/// The face closest to such a point is split there, or one of its edges, or one of its corners moves there: whichever
/// leaves the points around the nearest to the faces around, by their squared distances. It must leave all of them
/// clearly nearer than the point was, and turn no face by more than a right angle; and one of the faces around must
/// face as the point does, lest a point of the far side of a thin wall pulls this side through. The farthest points
/// come first. The topology stays.
///
/// @param vertices  (v, 3), each on a face
/// @param faces     (f, 3) edge- and vertex-manifold, oriented as the normals
/// @param points    (n, 3)
/// @param normals   (n, 3) unit
/// @param far       > 0: the distance from the mesh beyond which a point is far
/// @throws InvalidArgument on a broken contract
ReachedMesh reach_points(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points,
                         const PointsRef& normals, double far);

}  // namespace hdpea
