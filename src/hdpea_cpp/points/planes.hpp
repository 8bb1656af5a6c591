// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <utility>

namespace hdpea {

struct Plane {
  Eigen::Vector3d centre, normal;
};

/// The point on both planes that is nearest to a place, and the unit direction of their line; nothing of planes that
/// differ by less than about 17 degrees.
inline std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> intersection(const Plane& one, const Plane& other,
                                                                               const Eigen::Vector3d& place) {
  constexpr double least_sine = 0.3;
  const Eigen::Vector3d across = one.normal.cross(other.normal);
  const double sine = across.norm();
  if (!(sine >= least_sine)) return std::nullopt;
  const Eigen::Vector3d direction = across / sine;
  Eigen::Matrix3d rows;
  rows << one.normal.transpose(), other.normal.transpose(), direction.transpose();
  const Eigen::Vector3d right(one.normal.dot(one.centre - place), other.normal.dot(other.centre - place), 0);
  return std::pair{Eigen::Vector3d(place + rows.inverse() * right), direction};
}

}  // namespace hdpea
