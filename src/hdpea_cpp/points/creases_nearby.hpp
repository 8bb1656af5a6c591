// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/points/creases.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {

/// Creases as seen from places near them.
class CreasesNearby {
 public:
  explicit CreasesNearby(const Creases& creases) : creases_(creases), positions_(crease_positions(creases.samples)) {}

  Neighbors near(const Points& places) const { return nearest_neighbors(positions_, places, kNearest); }
  double spacing(Index s) const { return creases_.samples[s].spacing; }
  Eigen::RowVector3d direction(Index s) const { return creases_.samples[s].direction.transpose(); }
  /// Signed distance from the plane that halves the angle of the crease.
  double side(Index s, const Eigen::RowVector3d& x) const {
    const CreaseSample& sample = creases_.samples[s];
    return (sample.first - sample.second).normalized().dot(offset(s, x));
  }
  double along(Index s, const Eigen::RowVector3d& x) const { return creases_.samples[s].direction.dot(offset(s, x)); }
  Eigen::RowVector3d foot(Index s, const Eigen::RowVector3d& x) const {
    return positions_.row(s) + along(s, x) * direction(s);
  }
  double distance(Index s, const Eigen::RowVector3d& x) const { return (x - foot(s, x)).norm(); }
  /// Whether the sample speaks for this stretch of the crease.
  bool covers(Index s, const Eigen::RowVector3d& x) const { return std::abs(along(s, x)) <= kStretch * spacing(s); }
  /// How far a place is from the nearer of the two planes.
  double height(Index s, const Eigen::RowVector3d& x) const {
    const CreaseSample& sample = creases_.samples[s];
    return std::min(std::abs(sample.first.dot(offset(s, x))), std::abs(sample.second.dot(offset(s, x))));
  }

  /// Whether the crease is the nearest place of both its sides: in front of a convex one, or behind a concave one.
  bool is_beyond_both(Index s, const Eigen::RowVector3d& x) const {
    const CreaseSample& sample = creases_.samples[s];
    const double cosine = sample.first.dot(sample.second), sense = sample.convex ? 1 : -1;
    const double first = sample.first.dot(offset(s, x)), second = sample.second.dot(offset(s, x));
    return sense * (cosine * first - second) < 0 && sense * (cosine * second - first) < 0;
  }

 private:
  static constexpr Index kNearest = 16;
  /// In spacings each way: where few points lie on a crease, its samples are two and a half apart.
  static constexpr double kStretch = 1.5;

  Eigen::Vector3d offset(Index s, const Eigen::RowVector3d& x) const {
    return x.transpose() - creases_.samples[s].position;
  }

  const Creases& creases_;
  Points positions_;
};

}  // namespace hdpea
