// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace hdpea {

/// A triangle to which the distances of many points are measured.
class MeasuredTriangle {
 public:
  MeasuredTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  /// The squared distance of a point, or infinity if the plane of the triangle alone is no nearer than `bound`.
  double squared_distance(const Eigen::Vector3d& point, double bound) const;

  /// The weights of the corners at the place nearest to a point.
  Eigen::Vector3d weights(const Eigen::Vector3d& point) const;

 private:
  const Eigen::Vector3d& from(int i) const { return i == 0 ? a_ : i == 1 ? b_ : c_; }
  const Eigen::Vector3d& along(int i) const { return i == 0 ? ab_ : i == 1 ? bc_ : ca_; }

  /// Barycentric coordinates of the foot of a point on the plane; of a triangle without area, those of its first
  /// corner.
  Eigen::Vector3d coordinates(const Eigen::Vector3d& from_a) const;
  /// Whether the i-th side may be the nearest part to a point whose foot has these coordinates: it lies beyond it.
  bool may_be_nearest(int i, const Eigen::Vector3d& inside) const;
  /// The share of the i-th side at which it is nearest to a point.
  double share_along(int i, const Eigen::Vector3d& point) const;

  Eigen::Vector3d a_, b_, c_, ab_, bc_, ca_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero(), to_b_ = normal_, to_c_ = normal_;
  double inverse_[3];  ///< of the squared lengths of the sides; 0 of one without length
};

}  // namespace hdpea
