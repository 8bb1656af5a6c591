// SPDX-License-Identifier: GPL-3.0-or-later
// Single samples of creases become lines with corners.
#pragma once

#include <vector>

#include "hdpea_cpp/points/creases.hpp"

namespace hdpea {

/// The best samples, none within half a spacing of another in its direction.
std::vector<CreaseSample> thinned(std::vector<CreaseSample> samples);

/// Those that follow each other along lines at least `min_length` spacings long; `samples` are thinned.
///
/// Pieces of one line with a gap of up to 6 spacings count together, and so do lines that meet: what is short by
/// itself, as the edges of a slab, ends where others do. Samples whose residual is over `strong_residual` continue
/// lines, and add nothing to their length.
std::vector<CreaseSample> on_long_lines(const std::vector<CreaseSample>& samples, double min_length,
                                        double strong_residual);

/// Finds the corners where lines of different directions end, and adds samples from each end to its corner.
std::vector<Eigen::Vector3d> join_at_corners(std::vector<CreaseSample>& samples);

}  // namespace hdpea
