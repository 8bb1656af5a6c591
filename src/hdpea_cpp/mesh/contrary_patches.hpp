// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/mesh/incremental_manifold.hpp"

namespace hdpea {

/// What is to become of each face of a mesh for patches that hang on the rest by a neck, the wrong way round.
struct HangingPatches {
  std::vector<bool> turned;  ///< it is of such a patch
  std::vector<bool> cut;     ///< it is at the neck of one
  Index count = 0;           ///< of patches
};

/// Finds patches that hang on the rest by a neck, the wrong way round.
///
/// Faces of an edge-connected piece face the same way, whichever their points say: normals that are wrong here and
/// there do not tear a surface. But ground far from a scanner may join the rest along an edge or two, and there by
/// chance; a patch all of whose faces are against their points is then to be turned. A patch hangs by a neck if the
/// square of twice the number of edges that it shares with the rest is at most that of its faces: the corner of a
/// square sheet, cut off straight, shares twice as many.
///
/// @param against      of each face: whether it faces against its points
/// @param least_faces  smaller patches stay as they are
HangingPatches find_hanging_patches(const IncrementalManifold& mesh, const std::vector<bool>& against,
                                    Index least_faces);

}  // namespace hdpea
