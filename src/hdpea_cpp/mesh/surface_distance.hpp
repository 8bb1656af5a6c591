// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// What was to stay within a distance may come out a little farther.
constexpr double kRounding = 1 + 1e-9;

/// Points of a triangle mesh, one row per query.
struct SurfacePoints {
  /// (m) Euclidean distance from the query.
  Eigen::VectorXd distance;
  /// (m) the face the point lies on; the lowest index where it lies on several, but for rounding.
  Eigen::Vector<Index, Eigen::Dynamic> face;
  /// (m, 3) weights of the face's corners, >= 0, of sum 1.
  Points barycentric;
  /// (m, 3)
  Points position;
};

/// The point of a triangle mesh closest to each query.
///
/// Faces without area are allowed: they count as the segments or points they are.
///
/// @param vertices  (n, 3), finite
/// @param faces     (f, 3) indices into vertices, f >= 1; any soup
/// @param queries   (m, 3), finite
/// @throws InvalidArgument if there is no face, an index is out of range or a coordinate is not finite
SurfacePoints closest_surface_points(const PointsRef& vertices, const FacesRef& faces, const PointsRef& queries);

}  // namespace hdpea
