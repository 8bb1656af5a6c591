// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/crease_corners.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "hdpea_cpp/points/crease_lines.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::Vector3d;

struct Meeting {
  Vector position;
  double reach;  ///< from the two samples, together
  double spacing;
};

/// Where lines of samples near each other meet, the nearest to their samples first.
std::vector<Meeting> meetings(const std::vector<CreaseSample>& samples, const Points& positions) {
  constexpr Index neighbors = 24;
  const Neighbors near = nearest_neighbors(positions, neighbors);
  std::vector<Meeting> found;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (Index j : near.row(static_cast<Index>(i))) {
      if (j < static_cast<Index>(i)) continue;
      if (const auto point = meeting_point(samples[i], samples[j])) {
        const double reach = (*point - samples[i].position).norm() + (*point - samples[j].position).norm();
        found.push_back({*point, reach, samples[i].spacing});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Meeting& one, const Meeting& other) { return one.reach < other.reach; });
  return found;
}

/// One for all meetings within a spacing: the mean of those around the first.
std::vector<Meeting> merged(const std::vector<Meeting>& found) {
  std::vector<Meeting> corners;
  for (const Meeting& each : found) {
    const bool known = std::any_of(corners.begin(), corners.end(), [&](const Meeting& corner) {
      return (corner.position - each.position).norm() < each.spacing;
    });
    if (known) continue;
    Vector sum = Vector::Zero();
    int count = 0;
    for (const Meeting& other : found) {
      if ((other.position - each.position).norm() > 0.5 * each.spacing) continue;
      sum += other.position;
      ++count;
    }
    corners.push_back({sum / count, each.reach, each.spacing});
  }
  return corners;
}

Points positions_of(const std::vector<Meeting>& corners) {
  Points positions(corners.size(), 3);
  for (std::size_t c = 0; c < corners.size(); ++c) positions.row(c) = corners[c].position;
  return positions;
}

/// Where planes near a place meet, by least squares, with a little weight on the place: planes along a line hold
/// nothing on it.
class MeetingPlanes {
 public:
  MeetingPlanes(const Vector& place, double spacing) : place_(place), width_(kWidth * spacing) {}

  void add(const Vector& on, const Vector& normal) {
    const Vector offset = on - place_;
    const double weight = std::exp(-offset.squaredNorm() / (width_ * width_));
    matrix_ += weight * normal * normal.transpose();
    right_ += weight * normal.dot(offset) * normal;
    weights_ += weight;
  }

  Vector meeting() const {
    if (!std::isnormal(weights_)) return place_;
    return place_ + (matrix_ + kPull * weights_ * Eigen::Matrix3d::Identity()).ldlt().solve(right_);
  }

 private:
  static constexpr double kWidth = 1.5, kPull = 0.01;  // in spacings, and of all weights

  Vector place_;
  double width_, weights_ = 0;
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Zero();
  Vector right_ = Vector::Zero();
};

/// Moves corners to where the tangent planes of the points around them meet. Where these do not face as sides of the
/// samples do, they are smeared and would cut the corner off: it stays where it was, if that is near a sample.
std::vector<Meeting> settled(const std::vector<Meeting>& corners, const std::vector<CreaseSample>& samples,
                             const Points& positions, const PointsRef& points, const PointsRef& normals) {
  constexpr Index neighbors = 12;
  constexpr double least_cosine = 0.94, least_share = 0.8, near_by = 2.5;
  const Neighbors near = nearest_neighbors(points, positions_of(corners), neighbors),
                  near_samples = nearest_neighbors(positions, positions_of(corners), neighbors);
  std::vector<Meeting> kept;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    Meeting corner = corners[c];
    const auto around = near_samples.row(static_cast<Index>(c));
    const auto is_of_a_side = [&](const Vector& normal) {
      return std::any_of(around.begin(), around.end(), [&](Index s) {
        return s >= 0 && std::max(samples[s].first.dot(normal), samples[s].second.dot(normal)) >= least_cosine;
      });
    };
    MeetingPlanes planes(corner.position, corner.spacing);
    double count = 0, of_a_side = 0;
    for (Index p : near.row(static_cast<Index>(c))) {
      if (p < 0) break;
      planes.add(points.row(p), normals.row(p));
      of_a_side += is_of_a_side(normals.row(p));
      count += 1;
    }
    if (of_a_side >= least_share * count) {
      corner.position = planes.meeting();
    } else if ((samples[around(0)].position - corner.position).norm() > near_by * corner.spacing) {
      continue;
    }
    kept.push_back(corner);
  }
  return kept;
}

/// The lines that end in a corner, by their samples nearest to it.
class Ends {
 public:
  Ends(const std::vector<CreaseSample>& samples, const Vector& corner, Neighbors::ConstRowXpr near)
      : samples_(samples), corner_(corner) {
    for (Index i : near) {
      if (i >= 0 && reaches(samples[i])) around_.push_back(i);
    }
  }

  /// Whether lines of two directions do.
  bool make_a_corner() const {
    return std::any_of(around_.begin(), around_.end(), [&](Index i) {
      return std::any_of(around_.begin(), around_.end(), [&](Index j) {
        return std::abs(samples_[i].direction.dot(samples_[j].direction)) < kSameDirection;
      });
    });
  }

  /// Adds samples from each of them to the corner.
  void extend(std::vector<CreaseSample>& added) const {
    for (Index i : around_) {
      if (!is_last(i)) continue;
      CreaseSample next = samples_[i];
      const Vector apart = next.position - corner_;
      const double distance = apart.norm() / next.spacing;
      next.direction = apart.normalized();
      for (double step = kCreaseStep / 2; step < distance - kCreaseStep / 2; step += kCreaseStep) {
        next.position = corner_ + step * next.spacing * next.direction;
        added.push_back(next);
      }
    }
  }

 private:
  static constexpr double kReach = 4.5, kOff = 0.3;  // from a sample to the corner, and from its line, in spacings
  static constexpr double kSameDirection = 0.9;

  bool reaches(const CreaseSample& sample) const {
    return (sample.position - corner_).norm() <= kReach * sample.spacing &&
           off_line(sample, corner_) <= kOff * sample.spacing;
  }

  bool is_last(Index i) const {
    const Vector apart = samples_[i].position - corner_;
    return std::none_of(around_.begin(), around_.end(), [&](Index j) {
      if (j == i || std::abs(samples_[j].direction.dot(samples_[i].direction)) < kSameDirection) return false;
      const Vector other = samples_[j].position - corner_;
      return other.norm() < apart.norm() && other.dot(apart) > 0.8 * other.norm() * apart.norm() &&
             continues(samples_[i], samples_[j]);
    });
  }

  const std::vector<CreaseSample>& samples_;
  const Vector& corner_;
  std::vector<Index> around_;
};

}  // namespace

std::vector<Vector> join_at_corners(std::vector<CreaseSample>& samples, const PointsRef& points,
                                    const PointsRef& normals) {
  constexpr Index neighbors = 32;
  constexpr int rounds = 2;
  if (samples.empty()) return {};
  const Points positions = crease_positions(samples);
  std::vector<Meeting> found = merged(meetings(samples, positions));
  for (int round = 0; round < rounds && !found.empty(); ++round) {
    found = settled(found, samples, positions, points, normals);
  }
  if (found.empty()) return {};
  const Neighbors near = nearest_neighbors(positions, positions_of(found), neighbors);
  std::vector<Vector> corners;
  std::vector<CreaseSample> added;
  for (std::size_t c = 0; c < found.size(); ++c) {
    const Ends ends(samples, found[c].position, near.row(static_cast<Index>(c)));
    if (!ends.make_a_corner()) continue;
    corners.push_back(found[c].position);
    ends.extend(added);
  }
  samples.insert(samples.end(), added.begin(), added.end());
  return corners;
}

}  // namespace hdpea
