// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/crease_lines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "hdpea_cpp/base/angles.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::Vector3d;

/// What one sample adds to the length of its line, in spacings: thinned, they are kCreaseStep apart or a little more.
constexpr double kMeanStep = 0.6;

/// How far samples across a gap are turned from each other at most, or those on one arc from mirror images, in degrees.
constexpr double kTurnedAcrossGap = 12;

/// The widest gap in a line, in spacings.
constexpr double kMostGap = 6;

/// Whether the directions and sides of two samples differ by at most an angle, in degrees.
bool are_turned_alike(const CreaseSample& one, const CreaseSample& other, double most_turned) {
  const double least_cosine = cosine_of(most_turned);
  const auto agree = [&](const Vector& first, const Vector& second) {
    return one.first.dot(first) > least_cosine && one.second.dot(second) > least_cosine;
  };
  return std::abs(one.direction.dot(other.direction)) >= least_cosine &&
         (agree(other.first, other.second) || agree(other.second, other.first));
}

}  // namespace

double off_line(const CreaseSample& sample, const Vector& x) {
  const Vector offset = x - sample.position;
  return (offset - sample.direction * sample.direction.dot(offset)).norm();
}

bool continues(const CreaseSample& one, const CreaseSample& other, double most_turned, double most_off) {
  return are_turned_alike(one, other, most_turned) && off_line(one, other.position) < most_off * one.spacing &&
         off_line(other, one.position) < most_off * one.spacing;
}

std::optional<Vector> meeting_point(const CreaseSample& one, const CreaseSample& other) {
  constexpr double reach = 4, most_apart = 0.35;
  static const double most_cosine = cosine_of(30);
  const double cosine = one.direction.dot(other.direction);
  if (std::abs(cosine) > most_cosine) return std::nullopt;
  const Vector offset = other.position - one.position;
  const double along_one = offset.dot(one.direction), along_other = offset.dot(other.direction);
  const double s = (along_one - cosine * along_other) / (1 - cosine * cosine);
  const double t = (cosine * along_one - along_other) / (1 - cosine * cosine);
  const Vector p = one.position + s * one.direction, q = other.position + t * other.direction;
  if (std::max(std::abs(s), std::abs(t)) > reach * one.spacing) return std::nullopt;
  if ((p - q).norm() > most_apart * one.spacing) return std::nullopt;
  return (p + q) / 2;
}

namespace {

/// Whether an arc can join both between the same two surfaces: each is the mirror image of the other in the plane
/// half-way, and the arc does not bend much.
bool is_arc_between(const CreaseSample& one, const CreaseSample& other) {
  constexpr double most_bent = 25;  // from the chord
  const Vector chord = (other.position - one.position).normalized();
  if (std::abs(one.direction.dot(chord)) < cosine_of(most_bent)) return false;
  const auto mirrored = [&](const Vector& x) { return Vector(x - 2 * x.dot(chord) * chord); };
  CreaseSample image = one;
  image.direction = mirrored(one.direction);
  image.first = mirrored(one.first);
  image.second = mirrored(one.second);
  return are_turned_alike(image, other, kTurnedAcrossGap);
}

/// Whether both lie on one line, across a gap.
bool goes_on(const CreaseSample& one, const CreaseSample& other) {
  return continues(one, other, kTurnedAcrossGap) || is_arc_between(one, other);
}

/// The nearest of the samples near one that its line goes on to, forwards or backwards; -1 if there is none.
Index next_on_line(const std::vector<CreaseSample>& samples, Index i, double sense, Neighbors::ConstRowXpr near) {
  constexpr double ahead = 0.7;
  for (const Index j : near) {
    const Vector chord = j < 0 ? Vector::Zero() : Vector(samples[j].position - samples[i].position);
    if (j < 0 || chord.norm() > kMostGap * samples[i].spacing) break;
    if (sense * chord.dot(samples[i].direction) < ahead * chord.norm()) continue;
    if (goes_on(samples[i], samples[j])) return j;
  }
  return -1;
}

/// Adds samples between two, along the cubic that leaves and reaches them in their directions (Hermite).
void fill(const CreaseSample& one, const CreaseSample& other, double sense, std::vector<CreaseSample>& added) {
  constexpr double least_gap = 1.2;
  const Vector chord = other.position - one.position;
  const double apart = chord.norm() / one.spacing;
  if (apart <= least_gap) return;
  const Vector from = sense * one.direction, to = other.direction.dot(chord) < 0 ? -other.direction : other.direction;
  const bool swapped = one.first.dot(other.first) < one.first.dot(other.second);
  const int steps = static_cast<int>(std::ceil(apart / kCreaseStep));
  for (int step = 1; step < steps; ++step) {
    const double t = static_cast<double>(step) / steps, u = 1 - t;
    const auto between = [&](const Vector& x, const Vector& y) { return Vector((u * x + t * y).normalized()); };
    CreaseSample next = one;
    next.position = u * u * (1 + 2 * t) * one.position + t * t * (1 + 2 * u) * other.position +
                    t * u * chord.norm() * (u * from - t * to);
    next.direction = between(from, to);
    next.first = between(one.first, swapped ? other.second : other.first);
    next.second = between(one.second, swapped ? other.first : other.second);
    next.spacing = u * one.spacing + t * other.spacing;
    added.push_back(next);
  }
}

}  // namespace

std::vector<CreaseSample> thinned(std::vector<CreaseSample> samples) {
  constexpr Index neighbors = 48;
  constexpr double same_direction = 0.8;
  if (samples.empty()) return samples;
  std::stable_sort(samples.begin(), samples.end(),
                   [](const CreaseSample& one, const CreaseSample& other) { return one.residual < other.residual; });
  const Neighbors near = nearest_neighbors(crease_positions(samples), neighbors);
  std::vector<char> dropped(samples.size());
  std::vector<CreaseSample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (dropped[i]) continue;
    const CreaseSample& best = samples[i];
    kept.push_back(best);
    for (Index j : near.row(static_cast<Index>(i))) {
      if (j < 0 || (samples[j].position - best.position).norm() > kCreaseStep * best.spacing) continue;
      if (std::abs(samples[j].direction.dot(best.direction)) > same_direction) dropped[j] = true;
    }
  }
  return kept;
}

std::vector<CreaseSample> on_long_lines(const std::vector<CreaseSample>& samples, double min_length) {
  constexpr Index neighbors = 12, far_neighbors = 48;
  constexpr double most_apart = 2, most_apart_on_arc = 3, most_off_of_weak = 0.25;
  constexpr int least_of_piece = 4;
  if (samples.empty()) return samples;
  const Points positions = crease_positions(samples);
  const Neighbors near = nearest_neighbors(positions, far_neighbors);
  const Index count = positions.rows();
  const auto apart = [&](Index i, Index j) {
    return (positions.row(i) - positions.row(j)).norm() / samples[i].spacing;
  };
  // What is weak has to lie on a line more exactly.
  const auto joined = [&](Index i, Index j) {
    const bool both_strong = samples[i].strong && samples[j].strong;
    if (both_strong && apart(i, j) <= most_apart_on_arc && is_arc_between(samples[i], samples[j])) return true;
    if (apart(i, j) > most_apart) return false;
    return both_strong ? continues(samples[i], samples[j])
                       : continues(samples[i], samples[j], kTurnedAcrossGap, most_off_of_weak);
  };
  DisjointSets pieces(count);
  for (Index i = 0; i < count; ++i) {
    for (Index j : near.row(i).head(neighbors)) {
      if (j >= 0 && joined(i, j)) pieces.join(i, j);
    }
  }
  std::vector<int> sizes(samples.size(), 0);
  for (Index i = 0; i < count; ++i) ++sizes[pieces.find(i)];
  // Pieces of one line, and lines that meet, prove each other.
  DisjointSets lines(count);
  for (Index i = 0; i < count; ++i) {
    lines.join(i, pieces.find(i));
    if (sizes[pieces.find(i)] < least_of_piece) continue;
    for (Index j : near.row(i)) {
      if (j < 0 || sizes[pieces.find(j)] < least_of_piece) continue;
      const bool one_line = apart(i, j) <= kMostGap && goes_on(samples[i], samples[j]);
      if (one_line || meeting_point(samples[i], samples[j])) lines.join(i, j);
    }
  }
  std::vector<double> lengths(samples.size(), 0);
  for (Index i = 0; i < count; ++i) lengths[lines.find(i)] += samples[i].strong ? kMeanStep : 0;
  std::vector<CreaseSample> kept;
  for (Index i = 0; i < count; ++i) {
    if (lengths[lines.find(i)] >= min_length) kept.push_back(samples[i]);
  }
  return kept;
}

std::vector<CreaseSample> gaps_filled(std::vector<CreaseSample> samples) {
  constexpr Index neighbors = 24;
  if (samples.empty()) return samples;
  const Neighbors near = nearest_neighbors(crease_positions(samples), neighbors);
  std::vector<CreaseSample> added;
  for (Index i = 0; i < near.rows(); ++i) {
    for (const double sense : {-1.0, 1.0}) {
      const Index j = next_on_line(samples, i, sense, near.row(i));
      if (j > i) fill(samples[i], samples[j], sense, added);
    }
  }
  samples.insert(samples.end(), added.begin(), added.end());
  return samples;
}

}  // namespace hdpea
