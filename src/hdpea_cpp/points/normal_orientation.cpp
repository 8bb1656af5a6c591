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

namespace hdpea {
namespace {

/// n_i . n_j after n_i is carried along the arc from p_i to p_j.
double carried_cosine(const PointsRef& points, const PointsRef& normals, Index i, Index j) {
  const Eigen::RowVector3d edge = (points.row(j) - points.row(i)).stableNormalized();
  const Eigen::RowVector3d normal = normals.row(i);
  return (normal - 2 * normal.dot(edge) * edge).dot(normals.row(j));
}

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

/// Whether each piece (by its representative) faces inwards at its extreme points along 13 axes.
std::vector<char> face_inwards(const PointsRef& points, const Points& normals, const std::vector<Index>& piece) {
  std::vector<double> outward(piece.size(), 0);
  std::vector<double> highest(piece.size()), at_highest(piece.size());
  for (int code = 0; code < 27; ++code) {
    if (code == 13) continue;  // no direction
    const Eigen::RowVector3d axis = Eigen::RowVector3d(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1).normalized();
    std::fill(highest.begin(), highest.end(), -std::numeric_limits<double>::infinity());
    for (Index i = 0; i < points.rows(); ++i) {
      const double height = points.row(i).dot(axis);
      if (height <= highest[piece[i]]) continue;
      highest[piece[i]] = height;
      at_highest[piece[i]] = normals.row(i).dot(axis);
    }
    for (std::size_t root = 0; root < piece.size(); ++root) {
      if (piece[root] == static_cast<Index>(root)) outward[root] += at_highest[root];
    }
  }
  std::vector<char> inwards(piece.size());
  for (std::size_t root = 0; root < piece.size(); ++root) inwards[root] = outward[root] < 0;
  return inwards;
}

}  // namespace

Points orient_normals(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  const Index n = points.rows();
  require_neighborhoods(points, normals, neighbors);
  Points oriented = normals;
  for (Index i = 0; i < n; ++i) {
    // One sign for n and -n, whatever was given.
    Index largest;
    oriented.row(i).cwiseAbs().maxCoeff(&largest);
    if (oriented(i, largest) < 0) oriented.row(i) *= -1;
  }
  SignedSets pieces(n);
  for (const Edge& edge : sorted_edges(points, oriented, neighbors)) {
    pieces.join(edge.i, edge.j, carried_cosine(points, oriented, edge.i, edge.j) < 0);
  }
  std::vector<Index> piece(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    const auto [root, flipped] = pieces.find(i);
    piece[i] = root;
    if (flipped) oriented.row(i) *= -1;
  }
  const std::vector<char> inwards = face_inwards(points, oriented, piece);
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
