// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

struct FilledMesh {
  Points vertices;             ///< the given ones, then the centres of fans
  Faces faces;                 ///< the given ones, then the patches
  Index filled = 0, left = 0;  ///< holes, that is boundary loops
};

/// Fills the holes of a mesh up to a size; the others, and so the borders of an open scan, stay open.
///
/// The size of a hole is 4 area / perimeter of what closes it: the diameter of a round hole, twice the width of a
/// long slit. A patch that folds back over the mesh would close an outer border, not a hole: it is left out
/// unless everything is to be filled.
///
/// Each loop is triangulated by CGAL (least dihedral angles, then least area; Liepa 2003). Where such a patch
/// would use an edge or a face that the mesh has already, as a hole at a pinched place does, a fan around
/// the loop's centre takes its place: so the result is edge- and vertex-manifold and oriented, always. A loop of
/// more than 500 edges for which CGAL finds no patch quickly stays open, or gets a fan if everything is to be filled.
///
/// @param vertices  (v, 3)
/// @param faces     (f, 3) edge- and vertex-manifold, oriented
/// @param max_size  largest size of a hole; 0 fills nothing, infinity everything
/// @throws InvalidArgument on a broken contract; Cancelled
FilledMesh fill_holes(const PointsRef& vertices, const FacesRef& faces, double max_size, const Progress& progress = {});

}  // namespace hdpea
