// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/creases.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hdpea_cpp/base/angles.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/points/crease_corners.hpp"
#include "hdpea_cpp/points/crease_lines.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/wedge.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::Vector3d;
/// Several to a place where creases meet.
using Found = std::vector<std::vector<CreaseSample>>;

/// Nearest points that the spacing is told from.
constexpr int kOfSpacing = 12;

/// Nearest points to search for so many of two sides: some may belong to a third, or to another wall.
Index candidates(Index neighbors) { return neighbors * 3 / 2; }

class Search {
 public:
  Search(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options)
      : points_(points), normals_(normals), options_(options) {}

  /// Around some points. Of some of them the crease lies to one side, and the wedge fits less well.
  std::vector<CreaseSample> around_points(const std::vector<Index>& centres, const Neighbors& near) const {
    const double smooth = cosine_of(25), other_wall = -0.7, lenience = 2;
    Found found(centres.size());
    parallel_for(static_cast<Index>(centres.size()), [&](Index c) {
      const Vector centre = points_.row(centres[c]), own = normals_.row(centres[c]);
      const auto visible = [&](const Vector& normal) { return normal.dot(own) >= other_wall; };
      const Neighborhood around = neighborhood(centre, near.row(c), visible);
      if (around.points.empty()) return;
      const std::vector<Vector> normals = differing_normals(around);
      for (std::size_t a = 0; a < normals.size(); ++a) {
        for (std::size_t b = a + 1; b < normals.size(); ++b) {
          if (normals[a].dot(normals[b]) > smooth) continue;
          const auto made = sample(centre, near.row(c), normals[a], normals[b], lenience * options_.max_residual);
          if (made) found[c].push_back(*made);
        }
      }
    });
    return gathered(found);
  }

  /// Around the places that were found.
  std::vector<CreaseSample> around_samples(const std::vector<CreaseSample>& samples) const {
    if (samples.empty()) return {};
    const Neighbors near = nearest_neighbors(points_, crease_positions(samples), candidates(options_.neighbors));
    Found found(samples.size());
    parallel_for(static_cast<Index>(samples.size()), [&](Index i) {
      const CreaseSample& old = samples[i];
      const auto made = sample(old.position, near.row(i), old.first, old.second, options_.max_residual);
      if (made) found[i].push_back(*made);
    });
    return gathered(found);
  }

 private:
  template <class Row>
  double spacing(const Vector& centre, const Row& row) const {
    const Index last = std::min<Index>(kOfSpacing, points_.rows()) - 1;
    return (points_.row(row(last)).transpose() - centre).norm() * std::sqrt(std::numbers::pi / kOfSpacing);
  }

  /// Of the nearest points those that are wanted.
  template <class Row, class Wanted>
  Neighborhood neighborhood(const Vector& centre, const Row& row, const Wanted& wanted) const {
    Neighborhood around{{}, {}, centre, spacing(centre, row)};
    for (Index j : row) {
      if (j < 0 || static_cast<Index>(around.points.size()) == options_.neighbors) break;
      const Vector point = points_.row(j), normal = normals_.row(j);
      if (!wanted(normal)) continue;
      around.points.push_back(point);
      around.normals.push_back(normal);
    }
    return around;
  }

  /// Fits a wedge to the points whose normals are near one of two: near a corner there are others.
  template <class Row>
  std::optional<CreaseSample> sample(const Vector& centre, const Row& row, const Vector& first, const Vector& second,
                                     double share) const {
    constexpr std::size_t least_points = 10;
    constexpr double reach = 2.5;
    static const double of_a_side = cosine_of(50);
    const Neighborhood around = neighborhood(centre, row, [&](const Vector& normal) {
      return std::max(normal.dot(first), normal.dot(second)) >= of_a_side;
    });
    if (around.points.size() < least_points || !std::isnormal(around.spacing)) return std::nullopt;
    const auto wedge = fit_wedge(around, first, second);
    if (!wedge || !(wedge->first.dot(wedge->second) <= cosine_of(options_.min_angle))) return std::nullopt;
    if (!((wedge->position - around.centre).norm() <= reach * around.spacing)) return std::nullopt;
    const double smooth = quadric_residual(around, (wedge->first + wedge->second).normalized());
    if (!(wedge->residual <= share * smooth)) return std::nullopt;
    const double residual = wedge->residual / smooth;
    const bool strong = residual <= (wedge->bent ? options_.strong_bent : options_.strong_residual);
    return CreaseSample{wedge->position, wedge->direction, wedge->first, wedge->second,
                        wedge->convex,   around.spacing,   residual,     strong};
  }

  static std::vector<CreaseSample> gathered(const Found& found) {
    std::vector<CreaseSample> samples;
    for (const auto& each : found) {
      samples.insert(samples.end(), each.begin(), each.end());
    }
    return samples;
  }

  const PointsRef& points_;
  const PointsRef& normals_;
  const CreaseOptions& options_;
};

/// Points near which normals differ, with or without the smear of estimated ones: all others are left out at once.
std::vector<Index> near_bends(const PointsRef& points, const PointsRef& normals) {
  constexpr Index neighbors = 20;
  static const double bent = cosine_of(15);
  const Neighbors near = nearest_neighbors(points, points, neighbors);
  std::vector<Index> found;
  for (Index i = 0; i < points.rows(); ++i) {
    const auto differs = [&](Index j) { return j >= 0 && normals.row(i).dot(normals.row(j)) < bent; };
    if (std::any_of(near.row(i).begin(), near.row(i).end(), differs)) found.push_back(i);
  }
  return found;
}

/// Drops samples off the plane of the nearest point: between two surfaces that would meet there another one cuts the
/// corner off, as a chamfer does.
void drop_off_surface(std::vector<CreaseSample>& samples, const PointsRef& points, const PointsRef& normals) {
  constexpr double most_off = 0.5;  // in spacings
  if (samples.empty()) return;
  const Neighbors nearest = nearest_neighbors(points, crease_positions(samples), 1);
  std::vector<CreaseSample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Index p = nearest(static_cast<Index>(i), 0);
    const Vector offset = samples[i].position - points.row(p).transpose();
    if (std::abs(normals.row(p).dot(offset)) <= most_off * samples[i].spacing) kept.push_back(samples[i]);
  }
  samples = std::move(kept);
}

}  // namespace

Creases find_creases(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options) {
  constexpr int rounds = 2;
  require_finite(points, "points");
  require_rows(normals, points.rows(), "normals");
  require_finite(normals, "normals");
  require(options.neighbors >= kOfSpacing, "a crease needs 12 neighbors or more");
  std::vector<CreaseSample> samples;
  const std::vector<Index> bends = near_bends(points, normals);
  if (bends.empty()) return {};
  const Neighbors near = nearest_neighbors(points, points(bends, Eigen::all), candidates(options.neighbors));
  // Few points see a crease that turns, many one that is noisy; the better fit of both is kept.
  for (Index neighbors : {options.neighbors / 2 + 2, options.neighbors}) {
    CreaseOptions scale = options;
    scale.neighbors = neighbors;
    const Search search(points, normals, scale);
    std::vector<CreaseSample> found = search.around_points(bends, near);
    for (int round = 0; round < rounds; ++round) found = search.around_samples(found);
    samples.insert(samples.end(), found.begin(), found.end());
  }
  samples = gaps_filled(on_long_lines(thinned(samples), options.min_length));
  drop_off_surface(samples, points, normals);
  std::vector<Vector> corners = join_at_corners(samples, points, normals);
  return {std::move(samples), std::move(corners)};
}

Points crease_positions(const std::vector<CreaseSample>& samples) {
  Points positions(samples.size(), 3);
  for (std::size_t i = 0; i < samples.size(); ++i) positions.row(i) = samples[i].position;
  return positions;
}

Points crease_corners(const Creases& creases) {
  Points corners(creases.corners.size(), 3);
  for (std::size_t c = 0; c < creases.corners.size(); ++c) corners.row(c) = creases.corners[c];
  return corners;
}

}  // namespace hdpea
