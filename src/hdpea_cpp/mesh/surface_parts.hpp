// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// The part of a surface that a vertex of its mesh stands for.
struct SurfacePart {
  Eigen::Matrix4d quadric = Eigen::Matrix4d::Zero();  ///< of its tangent planes, weighted by area
  double area = 0;                                    ///< in R^d
  Eigen::VectorXd centroid;                           ///< in R^d

  /// The squared distance of a place from the planes, times the area.
  double squared_distance(const Eigen::Vector3d& at) const;
};

SurfacePart joined(const SurfacePart& a, const SurfacePart& b);

/// The growth of the variance of two parts, times their area, when they are joined (Ward 1963).
double variance_growth(const SurfacePart& a, const SurfacePart& b);

/// Where the planes of a part are nearest (Garland and Heckbert 1997).
///
/// @param pull  what draws the place towards `middle`, as a share of the planes: where they leave a direction
///              undetermined, it lies there
Eigen::Vector3d nearest_to_planes(const SurfacePart& part, const Eigen::Vector3d& middle, double pull);

/// The parts of all vertices.
///
/// The planes of a face are the tangent planes of the points that lie on it, which are true up to a crease, where the
/// face is not; each goes to the corners by its barycentric weights. A face without points has its own plane. Borders
/// are held by planes that stand upright on them.
///
/// @param vertices     (v, 3)
/// @param coordinates  (v, d)
/// @param faces        (f, 3) edge-manifold
/// @param points       (n, 3), n >= 0
/// @param normals      (n, 3) unit
/// @param border       weight of the planes of borders, where those of faces have 1
std::vector<SurfacePart> parts_of(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                                  const PointsRef& points, const PointsRef& normals, double border);

}  // namespace hdpea
