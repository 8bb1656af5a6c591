// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// How `wnnc_normals` iterates. The winding number is smoothed over a width that shrinks step by step.
struct WnncOptions {
  int iterations = 30;
  double first_width = 0.02;    ///< least, of the bounding box's diagonal
  double spacings_wide = 0.25;  ///< last width, in spacings of the points: above their noise, below walls
};

/// Unit normals that point out of what the points enclose, from the positions alone.
///
/// Normals are right when they are the gradient of the winding number that they generate (Lin, Shi & Liu, "Fast and
/// globally consistent normal orientation based on the winding number normal consistency", SIGGRAPH Asia 2024).
/// So each iteration takes a step of steepest descent towards a winding number of 1/2 in every point, then turns each
/// normal into the gradient and keeps its length, which converges to the area that the point represents.
///
/// Every component of a closed surface faces outwards, and a shell within another one into the hollow between them
/// and itself: inwards. Of an open surface, the side on which it is convex is out; a flat one has no such side, and
/// its normals are arbitrary. Widths are the same everywhere: they suit roughly even sampling.
///
/// @param points    (n, 3), n >= 1, finite and distinct
/// @returns (n, 3); the order of the points changes no more than the last digits
/// @throws InvalidArgument if a value is illegal; Cancelled
Points wnnc_normals(const PointsRef& points, const WnncOptions& options = {}, const Progress& progress = {});

}  // namespace hdpea
