// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/mesh/incremental_manifold.hpp"

namespace hdpea {

/// The size of candidate triangles, and how they lie to the points at their corners. It keeps references to the arrays.
class CandidateShape {
 public:
  /// @param coordinates  (n, d >= 3) of the points, positions first
  /// @param normals      (n, 3) unit
  /// @param disk_radii   (n) of their disks, in R^d
  CandidateShape(const CoordinatesRef& coordinates, const PointsRef& normals,
                 const Eigen::Ref<const Eigen::VectorXd>& disk_radii)
      : coordinates_(coordinates), normals_(normals), disk_radii_(disk_radii) {}

  Index vertices() const { return coordinates_.rows(); }

  /// In R^d; infinity if it has no area.
  double circumradius(const Triangle& triangle) const;

  /// The middle one of the radii of the corners' disks.
  double disk_radius(const Triangle& triangle) const;

  /// The normal of the ascending triangle in R^3, of twice its area's length.
  Eigen::Vector3d area_vector(const Triangle& triangle) const;

  /// Positive if the ascending triangle faces the way its points' normals do, times its area.
  double outwardness(const Triangle& triangle) const;

  /// Whether it lies in the plane of one of its points, to within an angle: at a crease it does in that of one only.
  bool agrees_with_points(const Triangle& triangle, double least_cosine) const;

  /// Whether it lies in the planes of two of its points that face opposite ways: of two sheets, or one wrongly
  /// oriented.
  bool faces_both_ways(const Triangle& triangle, double least_cosine) const;

 private:
  const CoordinatesRef& coordinates_;
  const PointsRef& normals_;
  const Eigen::Ref<const Eigen::VectorXd>& disk_radii_;
};

}  // namespace hdpea
