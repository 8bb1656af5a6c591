// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/restricted_voronoi.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

using Triple = std::array<Index, 3>;
constexpr Index kDisk = -1;       // label of an edge that lies on the disk's rim
constexpr int kDiskCorners = 10;  // HD-PEA, section C

/// Seeds whose triangles are gathered in one list: one for each seed would leave the memory in crumbs.
constexpr Index kSeedsAtOnce = 1024;

/// A corner of a cell, and the bisector (or the rim) on which the edge that starts there lies.
struct Corner {
  Eigen::Vector2d position;
  Index edge;
};
using Polygon = std::vector<Corner>;

void set_disk(double radius, Polygon& polygon) {
  polygon.clear();
  for (int corner = 0; corner < kDiskCorners; ++corner) {
    const double angle = 2 * std::numbers::pi * corner / kDiskCorners;
    polygon.push_back({radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), kDisk});
  }
}

double largest_squared_norm(const Polygon& polygon) {
  double largest = 0;
  for (const Corner& corner : polygon) largest = std::max(largest, corner.position.squaredNorm());
  return largest;
}

/// Keeps the part of a convex polygon where direction . u <= offset; new edges are labelled `label`.
void clip(const Eigen::Vector2d& direction, double offset, Index label, const Polygon& polygon, Polygon& clipped) {
  clipped.clear();
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& a = polygon[i];
    const Corner& b = polygon[(i + 1) % n];
    const double from_a = direction.dot(a.position) - offset;
    const double from_b = direction.dot(b.position) - offset;
    if (from_a <= 0) clipped.push_back(a);
    if ((from_a <= 0) == (from_b <= 0)) continue;
    const Eigen::Vector2d crossing = a.position + from_a / (from_a - from_b) * (b.position - a.position);
    // Leaving the half-plane, the new edge starts here; entering it, the old edge goes on.
    clipped.push_back({crossing, from_a <= 0 ? label : a.edge});
  }
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i].position;
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()].position;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// The triangles dual to the corners where two bisectors meet.
void dual_triangles(Index seed, const Polygon& polygon, std::vector<Triple>& triples) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Index before = polygon[(i + polygon.size() - 1) % polygon.size()].edge;
    const Index after = polygon[i].edge;
    if (before == kDisk || after == kDisk || before == after) continue;
    Triple triple{seed, before, after};
    std::sort(triple.begin(), triple.end());
    triples.push_back(triple);
  }
}

/// Sorts the triples and counts equal ones, at most three times each.
void collect(std::vector<Triple>& triples, Candidates& candidates) {
  tbb::parallel_sort(triples.begin(), triples.end());
  std::vector<int> counts;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triples.size();) {
    std::size_t end = i;
    while (end < triples.size() && triples[end] == triples[i]) ++end;
    triples[kept++] = triples[i];
    counts.push_back(static_cast<int>(std::min<std::size_t>(end - i, 3)));
    i = end;
  }
  candidates.triangles.resize(static_cast<Index>(kept), 3);
  for (std::size_t i = 0; i < kept; ++i) candidates.triangles.row(i) << triples[i][0], triples[i][1], triples[i][2];
  candidates.counts = Eigen::Map<Eigen::VectorXi>(counts.data(), static_cast<Index>(counts.size()));
}

}  // namespace

Candidates restricted_voronoi_candidates(const CoordinatesRef& seeds, const CoordinatesRef& bases,
                                         const NeighborsRef& neighbors,
                                         const Eigen::Ref<const Eigen::VectorXd>& radii) {
  const Index n = seeds.rows();
  const Index d = seeds.cols();
  require(bases.rows() == n && bases.cols() == 2 * d, "bases must be (n, 2 d)");
  require_finite(seeds, "seeds");
  require_finite(bases, "bases");
  require_neighbors(neighbors, n);
  require_rows(radii, n, "radii");
  require(radii.allFinite() && (radii.array() > 0).all(), "disk radii must be positive and finite");

  Candidates candidates{{}, {}, Eigen::VectorXd(n)};
  std::vector<std::vector<Triple>> triples_of(static_cast<std::size_t>((n + kSeedsAtOnce - 1) / kSeedsAtOnce));
  const auto cut = [&](Index i, std::vector<Triple>& triples) {
    thread_local Polygon polygon, clipped;
    set_disk(radii(i), polygon);
    double reach = largest_squared_norm(polygon);
    for (Index j : neighbors.row(i)) {
      if (j < 0) continue;
      const auto offset = seeds.row(j) - seeds.row(i);
      const double squared_distance = offset.squaredNorm();
      if (squared_distance > 4 * reach) break;
      if (squared_distance == 0) continue;  // a duplicate has no bisector
      const Eigen::Vector2d direction(bases.row(i).head(d).dot(offset), bases.row(i).tail(d).dot(offset));
      clip(direction, squared_distance / 2, j, polygon, clipped);
      polygon.swap(clipped);
      reach = largest_squared_norm(polygon);
    }
    candidates.cell_areas(i) = area(polygon);
    dual_triangles(i, polygon, triples);
  };
  parallel_for(
      static_cast<Index>(triples_of.size()),
      [&](Index part) {
        const Index end = std::min(n, (part + 1) * kSeedsAtOnce);
        for (Index i = part * kSeedsAtOnce; i < end; ++i) cut(i, triples_of[part]);
      },
      1);

  std::vector<Triple> triples;
  for (const auto& of_seeds : triples_of) triples.insert(triples.end(), of_seeds.begin(), of_seeds.end());
  triples_of.clear();
  collect(triples, candidates);
  return candidates;
}

}  // namespace hdpea
