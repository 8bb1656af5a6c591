// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/creases.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
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

double cosine_of(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

class Search {
 public:
  Search(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options)
      : points_(points), normals_(normals), options_(options) {}

  /// Around points near which normals differ. Around some of them the wedge lies to one side, and fits less well.
  std::vector<CreaseSample> around_points() const {
    const double smooth = cosine_of(25), other_wall = -0.7, lenience = 2;
    const Neighbors near = nearest_neighbors(points_, points_, candidates());
    Found found(static_cast<std::size_t>(points_.rows()));
    parallel_for(points_.rows(), [&](Index i) {
      const Vector own = normals_.row(i);
      const auto visible = [&](const Vector& normal) { return normal.dot(own) >= other_wall; };
      const Neighborhood around = neighborhood(points_.row(i), near.row(i), visible);
      if (around.points.empty()) return;
      const std::vector<Vector> normals = differing_normals(around);
      for (std::size_t a = 0; a < normals.size(); ++a) {
        for (std::size_t b = a + 1; b < normals.size(); ++b) {
          if (normals[a].dot(normals[b]) > smooth) continue;
          const auto made =
              sample(points_.row(i), near.row(i), normals[a], normals[b], lenience * options_.max_residual);
          if (made) found[i].push_back(*made);
        }
      }
    });
    return gathered(found);
  }

  /// Around the places that were found.
  std::vector<CreaseSample> around_samples(const std::vector<CreaseSample>& samples) const {
    if (samples.empty()) return {};
    const Neighbors near = nearest_neighbors(points_, crease_positions(samples), candidates());
    Found found(samples.size());
    parallel_for(static_cast<Index>(samples.size()), [&](Index i) {
      const CreaseSample& old = samples[i];
      const auto made = sample(old.position, near.row(i), old.first, old.second, options_.max_residual);
      if (made) found[i].push_back(*made);
    });
    return gathered(found);
  }

 private:
  /// Nearest points, of which some may belong to a third plane or to another wall.
  Index candidates() const { return options_.neighbors * 3 / 2; }

  /// Of the nearest points those with a normal that is wanted.
  template <class Row, class Wanted>
  Neighborhood neighborhood(const Vector& centre, const Row& row, const Wanted& wanted) const {
    Neighborhood around{{}, {}, centre, 0};
    double radius = 0;
    int count = 0;
    for (Index j : row) {
      if (j < 0 || static_cast<Index>(around.points.size()) == options_.neighbors) break;
      const Vector point = points_.row(j), normal = normals_.row(j);
      if (++count <= kOfSpacing) radius = (point - centre).norm();
      if (!wanted(normal)) continue;
      around.points.push_back(point);
      around.normals.push_back(normal);
    }
    around.spacing = radius * std::sqrt(std::numbers::pi / kOfSpacing);
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
    return CreaseSample{wedge->position, wedge->direction, wedge->first,
                        wedge->second,   around.spacing,   wedge->residual / smooth};
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

}  // namespace

Creases find_creases(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options) {
  constexpr int rounds = 2;
  require_finite(points, "points");
  require_rows(normals, points.rows(), "normals");
  require_finite(normals, "normals");
  require(options.neighbors >= kOfSpacing, "a crease needs 12 neighbors or more");
  std::vector<CreaseSample> samples;
  // Few points see a crease that turns, many one that is noisy; the better fit of both is kept.
  for (Index neighbors : {options.neighbors / 2 + 2, options.neighbors}) {
    CreaseOptions scale = options;
    scale.neighbors = neighbors;
    const Search search(points, normals, scale);
    std::vector<CreaseSample> found = search.around_points();
    for (int round = 0; round < rounds; ++round) found = search.around_samples(found);
    samples.insert(samples.end(), found.begin(), found.end());
  }
  samples = on_long_lines(thinned(samples), options.min_length);
  std::vector<Vector> corners = join_at_corners(samples);
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
