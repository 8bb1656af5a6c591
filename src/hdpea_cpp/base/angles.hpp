// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

namespace hdpea {

/// The cosine of an angle in degrees.
inline double cosine_of(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

}  // namespace hdpea
