// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace hdpea {

/// A triangle of a polygon, by the numbers of its corners.
using PolygonTriangle = std::array<int, 3>;

/// The triangulation of a closed polygon with the least sum of costs, by dynamic programming (Barequet and Sharir
/// 1995).
///
/// @param corners  of the polygon, numbered along it
/// @param cost     of the triangle of three ascending corners; infinity: no triangle may be there. Called for each
///                 three of them
/// @returns corners - 2 triangles, ascending, which run along the polygon; none if it has no triangulation
std::vector<PolygonTriangle> cheapest_triangulation(int corners, const std::function<double(int, int, int)>& cost);

}  // namespace hdpea
