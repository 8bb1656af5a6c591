// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/mesh/incremental_manifold.hpp"

namespace hdpea {

/// Gives every fan of faces around a vertex a vertex of its own, and leaves out vertices without faces.
///
/// Two fans meet in a pinched vertex, which is not a manifold one; fans are the faces around a vertex that
/// are connected through edges at it. Vertices are numbered by their source, copies after the original.
///
/// @param triangles     edge-manifold, indices below source_count
/// @param[out] faces    (f, 3) in the order of `triangles`
/// @param[out] sources  (v) which of the given vertices each one is
/// @returns how many copies were made
Index split_pinched_vertices(const std::vector<Triangle>& triangles, Index source_count, Faces& faces,
                             Eigen::Vector<Index, Eigen::Dynamic>& sources);

}  // namespace hdpea
