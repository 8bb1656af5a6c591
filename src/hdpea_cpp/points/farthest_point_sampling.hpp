// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Farthest-point sampling in R^d: each sample is the point farthest from the samples before it.
///
/// The result is the greedy definition's own, bit for bit: ties go to the lowest index, and a point is
/// taken once, so that duplicates come last. A kd-tree makes it fast: a sample at distance r from the others
/// can only change points within r, after Han et al., "QuickFPS", IEEE TCAD 42 (2023).
///
/// @param points    (n, d), finite
/// @param count     how many samples, 1 <= count <= n
/// @param first     indices of the first samples, which are taken as they are: at least one, at most `count`, all
///                  different
/// @param progress  may be empty
/// @returns (count) indices into points, all different, in the order of sampling
/// @throws InvalidArgument if count or first is out of range
Eigen::Vector<Index, Eigen::Dynamic> farthest_point_sampling(const CoordinatesRef& points, Index count,
                                                             const std::vector<Index>& first,
                                                             const Progress& progress = {});

}  // namespace hdpea
