// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Triangles dual to the vertices of the restricted Voronoi cells, and the cells' areas.
struct Candidates {
  Faces triangles;             ///< (t, 3), each row ascending, rows in lexicographic order
  Eigen::VectorXi counts;      ///< (t) in 1..3: how many of the three cells have this vertex; 3 is "T3"
  Eigen::VectorXd cell_areas;  ///< (n) area of each seed's cell in its tangent plane
};

/// Clips a disk in the tangent plane of every seed by the bisectors with its neighbours, in R^d.
///
/// In the plane of seed i, spanned by V_i, the bisector with j is the line u . V_i^T (x_j - x_i) =
/// |x_j - x_i|^2 / 2, so d enters in two dot products only. A polygon vertex between the bisectors with j
/// and k is dual to the triangle {i, j, k} (HD-PEA, sections 3.3, C and D; Boltcheva & Levy 2017).
///
/// @param seeds      (n, d)
/// @param bases      (n, 2 d) orthonormal tangent bases, as from tangent_bases()
/// @param neighbors  (n, k) nearest first in R^d, -1 pads; clipping stops once the next neighbour is farther
///                   than twice the farthest polygon vertex, so k need only cover twice the radius
/// @param radii      (n) radius of each seed's disk, a regular decagon
Candidates restricted_voronoi_candidates(const CoordinatesRef& seeds, const CoordinatesRef& bases,
                                         const NeighborsRef& neighbors, const Eigen::Ref<const Eigen::VectorXd>& radii);

}  // namespace hdpea
