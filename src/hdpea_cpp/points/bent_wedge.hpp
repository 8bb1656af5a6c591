// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "hdpea_cpp/points/wedge.hpp"

namespace hdpea {

/// Fits a wedge whose sides bend along its line, as those of the rim of a hole do: parabolic cylinders.
///
/// @param sides  of each point, whether it is of the first side
/// @param wedge  the straight one, of the same sides
/// @returns the wedge of the planes that touch the sides on the line, with the residual of the bent one; nothing if a
///          side has fewer than 6 points, or bends by more than a radius of 4 spacings
std::optional<Wedge> fit_bent_wedge(const Neighborhood& around, const std::vector<char>& sides, Wedge wedge);

}  // namespace hdpea
