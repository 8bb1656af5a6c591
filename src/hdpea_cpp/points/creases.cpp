// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/creases.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::Vector3d;

struct Plane {
  Vector centre, normal;
  double height(const Vector& x) const { return normal.dot(x - centre); }
};

/// Two half-planes that meet in a line.
struct Wedge {
  Plane first, second;
  Vector position, direction;
  /// Positive on the side of the first.
  double side(const Vector& x) const { return (first.normal - second.normal).dot(x - position) * sign; }
  double sign = 1;
  double residual = 0;
};

/// Points around a place, with their normals.
struct Neighborhood {
  std::vector<Vector> points, normals;
  Vector centre;
  double spacing;
};

/// Normals count a little: few points on a line leave a plane open.
constexpr double kNormalWeight = 0.05;
constexpr int kLeastPoints = 5;

template <class Member>
std::optional<Plane> fit_plane(const Neighborhood& around, Member&& member) {
  Vector sum = Vector::Zero(), normal_sum = Vector::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero(), tilt = squares;
  int count = 0;
  for (std::size_t i = 0; i < around.points.size(); ++i) {
    if (!member(i)) continue;
    const Vector x = (around.points[i] - around.centre) / around.spacing;
    sum += x;
    squares += x * x.transpose();
    normal_sum += around.normals[i];
    tilt += around.normals[i] * around.normals[i].transpose();
    ++count;
  }
  if (count < kLeastPoints) return std::nullopt;
  const Vector mean = sum / count;
  const Eigen::Matrix3d matrix = squares - count * mean * mean.transpose() - kNormalWeight * tilt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  Vector normal = solver.eigenvectors().col(0);
  if (normal.dot(normal_sum) < 0) normal = -normal;
  return Plane{around.centre + around.spacing * mean, normal};
}

/// The point on both planes that is nearest to the centre.
bool intersect(Wedge& wedge, const Vector& centre, double min_sine) {
  const Vector &m = wedge.first.normal, &n = wedge.second.normal;
  const Vector across = m.cross(n);
  const double sine = across.norm();
  if (sine < min_sine) return false;
  wedge.direction = across / sine;
  Eigen::Matrix3d rows;
  rows << m.transpose(), n.transpose(), wedge.direction.transpose();
  const Vector right(m.dot(wedge.first.centre), n.dot(wedge.second.centre), wedge.direction.dot(centre));
  wedge.position = rows.inverse() * right;
  return true;
}

/// Wedge by alternating assignment and fits, from two normals.
std::optional<Wedge> fit_wedge(const Neighborhood& around, const Vector& first, const Vector& second,
                               const CreaseOptions& options) {
  const std::size_t count = around.points.size();
  std::vector<char> in_first(count);
  for (std::size_t i = 0; i < count; ++i) in_first[i] = around.normals[i].dot(first - second) > 0;
  Wedge wedge;
  for (int round = 0; round < 10; ++round) {
    const auto a = fit_plane(around, [&](std::size_t i) { return in_first[i]; });
    const auto b = fit_plane(around, [&](std::size_t i) { return !in_first[i]; });
    if (!a || !b) return std::nullopt;
    wedge.first = *a;
    wedge.second = *b;
    if (!intersect(wedge, around.centre, 0.3)) return std::nullopt;
    wedge.sign = 1;
    if (wedge.side(a->centre) - wedge.side(b->centre) < 0) wedge.sign = -1;
    bool changed = false;
    for (std::size_t i = 0; i < count; ++i) {
      const char now = wedge.side(around.points[i]) > 0;
      changed = changed || now != in_first[i];
      in_first[i] = now;
    }
    if (!changed) break;
  }
  if (wedge.first.normal.dot(wedge.second.normal) > std::cos(options.min_angle * std::numbers::pi / 180)) {
    return std::nullopt;
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double height = (in_first[i] ? wedge.first : wedge.second).height(around.points[i]) / around.spacing;
    sum += height * height;
  }
  wedge.residual = sum / std::max<double>(static_cast<double>(count) - 6, 1);
  return wedge;
}

/// The two normals that differ most.
std::pair<Vector, Vector> extremes(const Neighborhood& around) {
  Vector mean = Vector::Zero();
  for (const Vector& n : around.normals) mean += n;
  const auto farthest = [&](const Vector& from) {
    return *std::min_element(around.normals.begin(), around.normals.end(),
                             [&](const Vector& m, const Vector& n) { return m.dot(from) < n.dot(from); });
  };
  const Vector first = farthest(mean);
  return {first, farthest(first)};
}

/// Variance off a quadratic surface over the plane across an axis, in squared spacings.
double quadric_residual(const Neighborhood& around, const Vector& axis) {
  const Index count = static_cast<Index>(around.points.size());
  const Vector u = axis.unitOrthogonal(), v = axis.cross(u);
  Eigen::Matrix<double, Eigen::Dynamic, 6> design(count, 6);
  Eigen::VectorXd height(count);
  for (Index i = 0; i < count; ++i) {
    const Vector x = (around.points[i] - around.centre) / around.spacing;
    const double a = u.dot(x), b = v.dot(x);
    design.row(i) << 1, a, b, a * a, a * b, b * b;
    height(i) = axis.dot(x);
  }
  const Eigen::Matrix<double, 6, 1> fit = design.householderQr().solve(height);
  double sum = 0;
  for (Index i = 0; i < count; ++i) {
    const double residual = height(i) - design.row(i).dot(fit);
    const double a = design(i, 1), b = design(i, 2);
    const double slope_a = fit(1) + 2 * fit(3) * a + fit(4) * b, slope_b = fit(2) + fit(4) * a + 2 * fit(5) * b;
    sum += residual * residual / (1 + slope_a * slope_a + slope_b * slope_b);
  }
  return sum / std::max<double>(static_cast<double>(count) - 6, 1);
}

struct Sample {
  Vector position, direction, first, second;
  double spacing, residual;
  double off_line(const Vector& x) const {
    const Vector offset = x - position;
    return (offset - direction * direction.dot(offset)).norm();
  }
};

class Search {
 public:
  Search(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options)
      : points_(points), normals_(normals), options_(options) {}

  Neighborhood around(const Vector& centre, const Vector& facing, double least_cosine, const auto& row) const {
    Neighborhood found;
    found.centre = centre;
    double radius = 0;
    int all = 0;
    for (Index j : row) {
      if (j < 0) continue;
      const Vector p = points_.row(j), n = normals_.row(j);
      if (++all <= 12) radius = (p - centre).norm();
      if (n.dot(facing) < least_cosine) continue;
      found.points.push_back(p);
      found.normals.push_back(n);
    }
    found.spacing = radius * std::sqrt(std::numbers::pi / 12);
    return found;
  }

  std::optional<Sample> sample(const Neighborhood& around, const Vector& first, const Vector& second,
                               double share) const {
    if (around.points.size() < 10 || around.spacing <= 0) return std::nullopt;
    const auto wedge = fit_wedge(around, first, second, options_);
    if (!wedge) return std::nullopt;
    if ((wedge->position - around.centre).norm() > 2.5 * around.spacing) return std::nullopt;
    const Vector axis = (wedge->first.normal + wedge->second.normal).normalized();
    if (wedge->residual > share * quadric_residual(around, axis)) return std::nullopt;
    return Sample{wedge->position, wedge->direction, wedge->first.normal, wedge->second.normal, around.spacing,
                  wedge->residual};
  }

 private:
  const PointsRef& points_;
  const PointsRef& normals_;
  const CreaseOptions& options_;
};

std::vector<Sample> gathered(const std::vector<std::optional<Sample>>& samples) {
  std::vector<Sample> kept;
  for (const auto& each : samples) {
    if (each) kept.push_back(*each);
  }
  return kept;
}

Points positions_of(const std::vector<Sample>& samples) {
  Points positions(samples.size(), 3);
  for (std::size_t i = 0; i < samples.size(); ++i) positions.row(i) = samples[i].position;
  return positions;
}

/// Whether both lie on one line between the same two planes.
bool continues(const Sample& one, const Sample& other) {
  const double cosine = std::cos(25 * std::numbers::pi / 180);
  if (std::abs(one.direction.dot(other.direction)) < cosine) return false;
  const auto agree = [&](const Vector& first, const Vector& second) {
    return one.first.dot(first) > cosine && one.second.dot(second) > cosine;
  };
  if (!agree(other.first, other.second) && !agree(other.second, other.first)) return false;
  return one.off_line(other.position) < 0.4 * one.spacing && other.off_line(one.position) < 0.4 * one.spacing;
}

/// The best samples, none within half a spacing of another on its line.
std::vector<Sample> thinned(std::vector<Sample> samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& one, const Sample& other) { return one.residual < other.residual; });
  const Neighbors near = nearest_neighbors(positions_of(samples), 48);
  std::vector<char> dropped(samples.size());
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (dropped[i]) continue;
    kept.push_back(samples[i]);
    for (Index j : near.row(static_cast<Index>(i))) {
      if (j < 0 || (samples[j].position - samples[i].position).norm() > 0.5 * samples[i].spacing) continue;
      dropped[j] = dropped[j] || std::abs(samples[j].direction.dot(samples[i].direction)) > 0.8;
    }
  }
  return kept;
}

/// Those on lines of some length.
std::vector<Sample> on_long_lines(const std::vector<Sample>& samples, double min_length) {
  const Neighbors near = nearest_neighbors(positions_of(samples), 12);
  DisjointSets lines(static_cast<Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (Index j : near.row(static_cast<Index>(i))) {
      if (j < 0 || (samples[j].position - samples[i].position).norm() > 2 * samples[i].spacing) continue;
      if (continues(samples[i], samples[j])) lines.join(static_cast<Index>(i), j);
    }
  }
  std::vector<double> length(samples.size(), 0);
  for (std::size_t i = 0; i < samples.size(); ++i) length[lines.find(static_cast<Index>(i))] += 0.6;
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (length[lines.find(static_cast<Index>(i))] >= min_length) kept.push_back(samples[i]);
  }
  return kept;
}

/// Where the lines of two samples meet, if they do.
std::optional<Vector> meeting_point(const Sample& one, const Sample& other) {
  const double cosine = one.direction.dot(other.direction);
  if (std::abs(cosine) > std::cos(30 * std::numbers::pi / 180)) return std::nullopt;
  const Vector offset = other.position - one.position;
  const double square = 1 - cosine * cosine;
  const double s = (offset.dot(one.direction) - cosine * offset.dot(other.direction)) / square;
  const double t = (cosine * offset.dot(one.direction) - offset.dot(other.direction)) / square;
  const double reach = 4 * one.spacing;
  const Vector p = one.position + s * one.direction, q = other.position + t * other.direction;
  if (std::abs(s) > reach || std::abs(t) > reach || (p - q).norm() > 0.35 * one.spacing) return std::nullopt;
  return (p + q) / 2;
}

/// Corners where lines of creases end, and samples from each line's end to it.
std::vector<Vector> join_at_corners(std::vector<Sample>& samples) {
  struct Candidate {
    Vector position;
    double reach, spacing;
  };
  const Points positions = positions_of(samples);
  const Neighbors near = nearest_neighbors(positions, 24);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (Index j : near.row(static_cast<Index>(i))) {
      if (j < static_cast<Index>(i)) continue;
      if (const auto point = meeting_point(samples[i], samples[j])) {
        const double reach = (*point - samples[i].position).norm() + (*point - samples[j].position).norm();
        candidates.push_back({*point, reach, samples[i].spacing});
      }
    }
  }
  if (candidates.empty()) return {};
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& one, const Candidate& other) { return one.reach < other.reach; });
  std::vector<Vector> corners;
  for (const Candidate& each : candidates) {
    const bool known = std::any_of(corners.begin(), corners.end(), [&](const Vector& corner) {
      return (corner - each.position).norm() < 1.0 * each.spacing;
    });
    if (known) continue;
    Vector sum = Vector::Zero();
    int count = 0;
    for (const Candidate& other : candidates) {
      if ((other.position - each.position).norm() > 0.5 * each.spacing) continue;
      sum += other.position;
      ++count;
    }
    corners.push_back(sum / count);
  }
  Points places(corners.size(), 3);
  for (std::size_t c = 0; c < corners.size(); ++c) places.row(c) = corners[c];
  const Neighbors around = nearest_neighbors(positions, places, 32);
  std::vector<Sample> more;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (Index i : around.row(c)) {
      if (i < 0) continue;
      Sample next = samples[i];
      const Vector offset = next.position - corners[c];
      const double distance = offset.norm();
      if (distance > 4.5 * next.spacing || next.off_line(corners[c]) > 0.3 * next.spacing) continue;
      // Only the end of the line walks to the corner.
      const Vector towards = offset / distance;
      const bool end = std::none_of(around.row(c).begin(), around.row(c).end(), [&](Index j) {
        if (j < 0 || j == i || std::abs(samples[j].direction.dot(next.direction)) < 0.9) return false;
        const Vector other = samples[j].position - corners[c];
        return other.norm() < distance && other.dot(towards) > 0.8 * other.norm() && continues(samples[i], samples[j]);
      });
      if (!end) continue;
      for (double step = 0.25 * next.spacing; step < distance - 0.25 * next.spacing; step += 0.5 * next.spacing) {
        next.position = corners[c] + step * towards;
        next.direction = towards;
        more.push_back(next);
      }
    }
  }
  samples.insert(samples.end(), more.begin(), more.end());
  return corners;
}

}  // namespace

Creases find_creases(const PointsRef& points, const PointsRef& normals, const CreaseOptions& options) {
  const Index count = points.rows();
  const Neighbors neighbors = nearest_neighbors(points, points, options.neighbors);
  const Search search(points, normals, options);
  std::vector<std::optional<Sample>> coarse(count);
  parallel_for(count, [&](Index i) {
    const Vector n = normals.row(i);
    const Neighborhood around = search.around(points.row(i), n, -0.7, neighbors.row(i));
    const auto [first, second] = extremes(around);
    if (first.dot(second) > std::cos(25 * std::numbers::pi / 180)) return;
    coarse[i] = search.sample(around, first, second, 2 * options.max_residual);
  });
  std::vector<Sample> samples = gathered(coarse);
  for (int round = 0; round < 2 && !samples.empty(); ++round) {
    const Neighbors near = nearest_neighbors(points, positions_of(samples), options.neighbors);
    std::vector<std::optional<Sample>> finer(samples.size());
    parallel_for(static_cast<Index>(samples.size()), [&](Index i) {
      const Sample& old = samples[i];
      const Neighborhood around =
          search.around(old.position, (old.first + old.second).normalized(), -0.2, near.row(i));
      finer[i] = search.sample(around, old.first, old.second, options.max_residual);
    });
    samples = gathered(finer);
  }
  Creases creases;
  creases.corners.resize(0, 3);
  if (!samples.empty()) samples = on_long_lines(thinned(samples), options.min_length);
  if (!samples.empty()) {
    const std::vector<Vector> corners = join_at_corners(samples);
    creases.corners.resize(static_cast<Index>(corners.size()), 3);
    for (std::size_t c = 0; c < corners.size(); ++c) creases.corners.row(c) = corners[c];
  }
  const Index found = static_cast<Index>(samples.size());
  creases.positions = positions_of(samples);
  creases.directions.resize(found, 3);
  creases.first_normals.resize(found, 3);
  creases.second_normals.resize(found, 3);
  creases.spacings.resize(found);
  for (Index i = 0; i < found; ++i) {
    creases.directions.row(i) = samples[i].direction;
    creases.first_normals.row(i) = samples[i].first;
    creases.second_normals.row(i) = samples[i].second;
    creases.spacings(i) = samples[i].spacing;
  }
  return creases;
}

}  // namespace hdpea
