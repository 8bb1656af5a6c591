// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normal_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/signed_sets.hpp"
#include "hdpea_cpp/points/carried_normals.hpp"

namespace hdpea {
namespace {

struct Edge {
  double cost;
  Index i, j;
  bool operator<(const Edge& other) const { return std::tie(cost, i, j) < std::tie(other.cost, other.i, other.j); }
};

std::vector<Edge> sorted_edges(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  std::vector<Edge> edges;
  for (Index i = 0; i < neighbors.rows(); ++i) {
    for (Index j : neighbors.row(i)) {
      if (j >= 0)
        edges.push_back({1 - std::abs(carried_cosine(points, normals, i, j)), std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// What is summed over a piece of the surface to find the side it faces.
struct Sums {
  double area = 0, volume = 0;
  Eigen::RowVector3d position = Eigen::RowVector3d::Zero(), vector_area = Eigen::RowVector3d::Zero();

  /// Closed or nearly: its volume is negative. Open and rather flat, it has no inside: it faces down an axis.
  bool faces_inwards() const {
    if (vector_area.norm() <= kFlat * area) return volume < vector_area.dot(position) / area;
    Index axis;
    vector_area.cwiseAbs().maxCoeff(&axis);
    return vector_area(axis) < 0;
  }

  /// Share of the area beyond which the vector area is that of a piece without an inside; half a sphere has 0.5.
  static constexpr double kFlat = 0.6;
};

/// Whether each piece (by its representative) faces inwards, by all its points.
std::vector<char> face_inwards(const PointsRef& points, const Points& normals, const NeighborsRef& neighbors,
                               const std::vector<Index>& piece) {
  const Eigen::VectorXd areas = neighborhood_areas(points, neighbors);
  const Eigen::RowVector3d middle = points.colwise().mean();
  std::vector<Sums> sums(piece.size());
  for (Index i = 0; i < points.rows(); ++i) {
    Sums& sum = sums[piece[i]];
    const Eigen::RowVector3d position = points.row(i) - middle;
    sum.area += areas(i);
    sum.volume += areas(i) * position.dot(normals.row(i));
    sum.position += areas(i) * position;
    sum.vector_area += areas(i) * normals.row(i);
  }
  std::vector<char> inwards(piece.size());
  for (std::size_t root = 0; root < piece.size(); ++root)
    inwards[root] = sums[root].area > 0 && sums[root].faces_inwards();
  return inwards;
}

}  // namespace

Points orient_normals(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                      const MaskRef& known) {
  const Index n = points.rows();
  require_neighborhoods(points, normals, neighbors);
  require(known.size() == 0 || known.size() == n, "what is known must be so of each point");
  const auto is_known = [&](Index i) { return known.size() > 0 && known(i); };
  Points oriented = normals;
  for (Index i = 0; i < n; ++i) {
    if (is_known(i)) continue;
    // One sign for n and -n, whatever was given.
    Index largest;
    oriented.row(i).cwiseAbs().maxCoeff(&largest);
    if (oriented(i, largest) < 0) oriented.row(i) *= -1;
  }
  SignedSets pieces(n);
  Index first_known = -1;
  for (Index i = 0; i < n; ++i) {
    if (!is_known(i)) continue;
    if (first_known < 0) first_known = i;
    pieces.join(first_known, i, false);
  }
  for (const Edge& edge : sorted_edges(points, oriented, neighbors)) {
    pieces.join(edge.i, edge.j, carried_cosine(points, oriented, edge.i, edge.j) < 0);
  }
  std::vector<Index> piece(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    const auto [root, flipped] = pieces.find(i);
    piece[i] = root;
    if (flipped) oriented.row(i) *= -1;
  }
  std::vector<char> inwards = face_inwards(points, oriented, neighbors, piece);
  // The known ones turn back to the signs that they had.
  if (first_known >= 0) inwards[piece[first_known]] = pieces.find(first_known).second;
  for (Index i = 0; i < n; ++i) {
    if (inwards[piece[i]]) oriented.row(i) *= -1;
  }
  return oriented;
}

Points agree_on_signs(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                      double least_cosine) {
  const Index n = points.rows();
  require(least_cosine >= -1, "the least cosine must be at least -1");
  require_neighborhoods(points, normals, neighbors);
  SignedSets pieces(n);
  for (const Edge& edge : sorted_edges(points, normals, neighbors)) {
    if (edge.cost > 1 - least_cosine) break;
    pieces.join(edge.i, edge.j, carried_cosine(points, normals, edge.i, edge.j) < 0);
  }
  std::vector<Index> votes(static_cast<std::size_t>(n), 0);
  for (Index i = 0; i < n; ++i) {
    const auto [root, flipped] = pieces.find(i);
    votes[root] += flipped ? -1 : 1;
  }
  Points agreed = normals;
  for (Index i = 0; i < n; ++i) {
    const auto [root, flipped] = pieces.find(i);
    // The piece has the sign of its root where most members are not flipped against it.
    if (flipped != (votes[root] < 0)) agreed.row(i) *= -1;
  }
  return agreed;
}

double orientation_consistency(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  require_neighborhoods(points, normals, neighbors);
  Index agree = 0, count = 0;
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index j : neighbors.row(i)) {
      if (j < 0) continue;
      const double cosine = carried_cosine(points, normals, i, j);
      count += std::abs(cosine) > 0.8;
      agree += cosine > 0.8;
    }
  }
  return count == 0 ? 1 : static_cast<double>(agree) / static_cast<double>(count);
}

}  // namespace hdpea
