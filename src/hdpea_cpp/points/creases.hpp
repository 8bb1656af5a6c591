// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// What counts as a crease. Spacings are local: the square root of the area per point.
///
/// The limits are such that bull and kitten, 40,000 points each, show none, with noise of up to 0.3 spacings or
/// without. Without the weak samples, of the creases of fandisk with noise of 0.1 spacings 58 % would be found, not 84
/// %.
struct CreaseOptions {
  Index neighbors = 32;          ///< points that two half-planes are fitted to, and a little more than half as many
  double min_angle = 40;         ///< degrees between their normals
  double max_residual = 0.5;     ///< variance off the half-planes, as a share of that off a quadratic surface
  double strong_residual = 0.4;  ///< the same where a place proves a crease, and does not only continue one
  double strong_bent = 0.16;     ///< the same where the sides bend: such a wedge fits more places by chance
  double min_length = 16;        ///< of lines of creases that meet, together, in spacings, where they are strong
};

/// A place on a crease.
struct CreaseSample {
  Eigen::Vector3d position;
  Eigen::Vector3d direction;      ///< unit, along the crease, of either sign
  Eigen::Vector3d first, second;  ///< unit normals of the planes on its two sides, on the side of those of the points
  bool convex;                    ///< whether each side lies behind the plane of the other
  double spacing;                 ///< of the points there
  double residual;                ///< variance off the sides, as a share of that off a quadratic surface
  bool strong;                    ///< whether it proves a crease, and does not only continue one
};

/// Sharp edges that points show.
struct Creases {
  std::vector<CreaseSample> samples;     ///< about two to a spacing along every crease
  std::vector<Eigen::Vector3d> corners;  ///< where creases meet, or one bends by 30 degrees within few spacings
};

/// Finds the sharp edges that points show.
///
/// Around a point near which normals differ, two half-planes that meet in a line (a wedge) are fitted to the nearest
/// points whose normals are near those of the two, and once more around the line; where these fit much better, with
/// sides that bend along the line, as around the rim of a hole. They are a crease where they fit far better than a
/// smooth quadratic surface: noise is as far off the one as off the other, and a bend wider than the points are apart
/// is farther off the wedge. Normals are where the fit begins; they may be smeared across the crease, as estimated ones
/// are. Samples count only where they follow each other along a line or an arc of some length, whose gaps are filled.
/// Where such lines end and meet is a corner, and the lines go on up to it.
///
/// @param points   (n, 3), n >= 1
/// @param normals  (n, 3) unit, consistently oriented
/// @throws InvalidArgument on a broken contract
Creases find_creases(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options = {});

/// (m, 3)
Points crease_positions(const std::vector<CreaseSample>& samples);

/// (c, 3)
Points crease_corners(const Creases& creases);

}  // namespace hdpea
