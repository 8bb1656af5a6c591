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

  Eigen::Vector3d a_, b_, c_, ab_, bc_, ca_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero(), to_b_ = normal_, to_c_ = normal_;
};

}  // namespace hdpea
