// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/mesh/restricted_voronoi.hpp"

namespace hdpea {

/// What is refused when triangles are chosen from the candidates. Angles are in degrees.
struct ExtractionOptions {
  double max_fold = 120;           ///< largest angle between the normals of faces that share an edge, for T12
  double max_normal_angle = 60;    ///< largest angle between a face's plane and the nearest of its points' planes
  double max_lone_angle = 45;      ///< the same for T12 that bring a vertex, which may be of another sheet
  double max_circumradius = 1.2;   ///< in R^d, in the radii of the corners' disks, of which the middle one counts
  Index max_bridged_faces = 64;    ///< larger pieces are not joined by a triangle that shares one edge
  Index min_component_faces = 16;  ///< smaller connected pieces are dropped, but never the largest
};

/// How many candidates were kept, and why the others were refused.
struct ExtractionCounts {
  Index t3 = 0, t12 = 0;            ///< candidates
  Index t3_kept = 0, t12_kept = 0;  ///< those in the mesh
  Index refused_edge = 0;           ///< an edge would get a third face
  Index refused_link = 0;           ///< a vertex link would stop being a path or a cycle
  Index refused_orientation = 0;    ///< would make a Moebius strip
  Index refused_fold = 0;           ///< folds back on its neighbour
  Index refused_normal = 0;         ///< crosses the surface: its plane disagrees with the points'
  Index refused_size = 0;           ///< spans more than the disks allow
  Index refused_sides = 0;          ///< joins two large pieces of which one would face against its points
  Index refused_loose = 0;          ///< T12 that never shared enough edges with the mesh
  Index dropped_components = 0, dropped_faces = 0;
  Index turned_patches = 0;  ///< hung on the rest by a neck, against their points
  Index split_vertices = 0;  ///< pinched vertices given a copy of their own for each fan
};

struct ExtractedMesh {
  Faces faces;                                   ///< (f, 3), oriented as the normals, in lexicographic order
  Eigen::Vector<Index, Eigen::Dynamic> sources;  ///< (v) the seed of each vertex
  ExtractionCounts counts;
};

/// Chooses an edge- and vertex-manifold, oriented mesh from the candidates (HD-PEA, section D; Geogram's Co3Ne).
///
/// T3 first, then T12, best first: seen twice before once, then by circumradius in R^d. T3 in the planes of points
/// that face opposite ways come after the others: where two things touch, they join these. A T12 triangle must
/// share two edges with the mesh, or one and bring a vertex that has no face yet; sweeps repeat until none
/// is inserted, and then once more with those that share one edge and reach a vertex of another piece, one of the two
/// being small: on parts so thin that few cells agree, they join the fragments. Then small components are dropped,
/// patches that hang on the rest the wrong way round turned, and pinched vertices split. Borders stay open.
///
/// @param coordinates  (n, d) seeds; their first three columns are positions in R^3
/// @param normals      (n, 3) unit; their signs decide which side of a whole component is out, and that no
///                     component is joined to another the wrong way round; signs that are wrong here and there do not
///                     matter
/// @param disk_radii   (n) in R^d, those that the cells were cut by. A stray seed has a wide disk; two corners with
///                     disks of the usual size keep it from drawing the surface out to a spike
ExtractedMesh extract_manifold(const CoordinatesRef& coordinates, const PointsRef& normals,
                               const Eigen::Ref<const Eigen::VectorXd>& disk_radii, const Candidates& candidates,
                               const ExtractionOptions& options);

}  // namespace hdpea
