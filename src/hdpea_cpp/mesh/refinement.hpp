// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// How a mesh is fitted to a cloud.
struct RefinementOptions {
  Index rounds = 2;         ///< rounds of projection and fitting; 0 leaves the mesh as it is
  double pull = 0.01;       ///< weight of staying, as a share of the points per vertex, > 0
  double min_cosine = 0.3;  ///< points whose normal agrees less with their face's belong to another sheet
  double max_distance = 4;  ///< points farther off, in sizes of the faces there, are of what is missing
  double max_gap = 0.5;     ///< how far from the points a vertex may move, in sizes of its faces, sqrt(2 area)
  double max_turn = 60;     ///< degrees a face may turn in one round
  double min_area = 0.2;    ///< share of its area that a face keeps in one round

  /// Where an error is to be kept, nothing is to be even: vertices stay less, and faces come nearer to the points.
  static RefinementOptions within_error() { return {.pull = 0.005}; }
};

/// Moves the vertices so that the faces run through the cloud, by least squares.
///
/// Vertices on tangent planes cut off corners. Each round asks of every point p with normal n, projected to
/// the face with corners x_b and weights w_b, that n . (sum_b w_b x_b - p) = 0, and of every vertex that it
/// stays (weakly), and solves the sparse normal equations once (VertexSystem). Where a face would flip or be squashed,
/// or a vertex leave the cloud, steps are shortened.
///
/// @param vertices  (v, 3)
/// @param faces     (f, 3) oriented as the normals
/// @param points    (n, 3)
/// @param normals   (n, 3) unit
/// @param fixed     (v) vertices that stay where they are, or empty: none
/// @returns (v, 3)
/// @throws InvalidArgument on a broken contract; Cancelled
Points refine_vertices(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points,
                       const PointsRef& normals, const RefinementOptions& options, const Progress& progress = {},
                       const MaskRef& fixed = Mask());

}  // namespace hdpea
