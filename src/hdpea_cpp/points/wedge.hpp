// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Points around a place, with their normals.
struct Neighborhood {
  std::vector<Eigen::Vector3d> points, normals;
  Eigen::Vector3d centre;
  double spacing;  ///< of the points, > 0
};

/// Two half-planes that meet in a line, the crease.
struct Wedge {
  Eigen::Vector3d position;       ///< of the line, nearest to the centre of the neighbourhood
  Eigen::Vector3d direction;      ///< of the line, unit
  Eigen::Vector3d first, second;  ///< unit normals of the planes, on the side of those of the points
  bool convex;                    ///< whether each side lies behind the plane of the other
  double residual;                ///< variance of the points off its sides, in squared spacings
  bool bent;                      ///< whether the sides bend along the line, and the planes touch them there
};

/// The variance of points off what was fitted to them with so many unknowns, from the sum of their squared distances.
inline double variance(double squares, std::size_t points, double unknowns) {
  return squares / std::max(static_cast<double>(points) - unknowns, 1.0);
}

/// The two normals that differ most, and up to two more that differ from all before, as around a corner.
std::vector<Eigen::Vector3d> differing_normals(const Neighborhood& around);

/// Fits a wedge: points are assigned to half-planes and planes to points, in turn, as in k-means. Where sides that bend
/// along the line fit much better, it is that of the planes that touch these.
///
/// @param first, second  unit normals to begin with: points belong to the one that theirs is nearer to
/// @returns nothing if a plane has fewer than 5 points, or the planes differ by less than about 17 degrees
std::optional<Wedge> fit_wedge(const Neighborhood& around, const Eigen::Vector3d& first, const Eigen::Vector3d& second);

/// The variance of points off the quadratic height field that fits them best, over the plane across an axis, in squared
/// spacings: what it takes to call them smooth.
double quadric_residual(const Neighborhood& around, const Eigen::Vector3d& axis);

}  // namespace hdpea
