// SPDX-License-Identifier: GPL-3.0-or-later
// Single samples of creases become lines.
#pragma once

#include <optional>
#include <vector>

#include "hdpea_cpp/points/creases.hpp"

namespace hdpea {

/// Thinned samples are at least so many spacings apart along a line.
constexpr double kCreaseStep = 0.5;

/// The distance of a place from the line of a sample.
double off_line(const CreaseSample& sample, const Eigen::Vector3d& x);

/// Whether both lie on one line between the same two surfaces: turned by at most an angle in degrees, and off it by at
/// most so many spacings.
bool continues(const CreaseSample& one, const CreaseSample& other, double most_turned = 25, double most_off = 0.4);

/// Where the lines of two samples of different directions meet, if they do near both.
std::optional<Eigen::Vector3d> meeting_point(const CreaseSample& one, const CreaseSample& other);

/// The best samples, none within half a spacing of another in its direction.
std::vector<CreaseSample> thinned(std::vector<CreaseSample> samples);

/// Those that follow each other along lines at least `min_length` spacings long; `samples` are thinned.
///
/// Pieces of one line with a gap of up to 6 spacings count together, and so do lines that meet: what is short by
/// itself, as the edges of a slab, ends where others do. Samples that are not strong continue
/// lines, and add nothing to their length.
std::vector<CreaseSample> on_long_lines(const std::vector<CreaseSample>& samples, double min_length);

/// Adds samples where the next one on a line is far, along the arc between them.
std::vector<CreaseSample> gaps_filled(std::vector<CreaseSample> samples);

}  // namespace hdpea
