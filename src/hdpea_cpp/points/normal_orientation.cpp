// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normal_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/signed_sets.hpp"
#include "hdpea_cpp/points/signed_contraction.hpp"

namespace hdpea {
namespace {

/// n_i . n_j after n_i is carried along the arc from p_i to p_j.
double carried_cosine(const PointsRef& points, const PointsRef& normals, Index i, Index j) {
  const Eigen::RowVector3d edge = (points.row(j) - points.row(i)).stableNormalized();
  const Eigen::RowVector3d normal = normals.row(i);
  return (normal - 2 * normal.dot(edge) * edge).dot(normals.row(j));
}

/// Edges that join points at once: their cost, 1 - |cosine|, is at most this, and the set has so few points. What is
/// joined so cannot be parted by what is seen of a larger part.
constexpr double small_cost = 0.05;
constexpr Index most_at_once = 8;
/// |cosine| above which an edge says something, and the share of those at the border of a part that decides; where
/// there are few, as of a point between two balls that touch, of so many.
constexpr double conclusive = 0.8, most_of_border = 0.7;
constexpr Index fewest_edges = 4;

/// 1 - |cosine|: how little an edge says.
double cost(const SignedEdge& edge) { return 1 - std::abs(edge.weight); }

/// The edges to neighbours, weighted by the carried cosine, by ascending cost.
std::vector<SignedEdge> sorted_edges(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  std::vector<SignedEdge> edges;
  for (Index i = 0; i < neighbors.rows(); ++i) {
    for (Index j : neighbors.row(i)) {
      const auto [low, high] = std::minmax(i, j);
      if (j >= 0) edges.push_back({low, high, carried_cosine(points, normals, low, high)});
    }
  }
  const auto key = [](const SignedEdge& edge) { return std::tuple(cost(edge), edge.i, edge.j); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return edges;
}

/// Sets of points with the signs that most of their edges agree with.
///
/// @param known  (n) whose signs are right: they are one set
/// @param vote   weight of the sign that each point has on entry, towards the member n; with 0 there is none
SignedSets joined_by_edges(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                           const Mask& known, double vote) {
  const Index n = points.rows();
  SignedSets sets(n + (vote > 0));
  for (Index i = 0, first = -1; i < n; ++i) {
    if (!known(i)) continue;
    if (first < 0) first = i;
    sets.join(first, i, false);
  }
  std::vector<SignedEdge> edges;
  for (const SignedEdge& edge : sorted_edges(points, normals, neighbors)) {
    if (known(edge.i) && known(edge.j)) continue;
    if (cost(edge) < small_cost && !known(edge.i) && !known(edge.j) &&
        sets.size(edge.i) + sets.size(edge.j) <= most_at_once) {
      sets.join(edge.i, edge.j, edge.weight < 0);
    } else {
      edges.push_back(edge);
    }
  }
  for (Index i = 0; vote > 0 && i < n; ++i) edges.push_back({i, n, vote});
  join_by_weight(sets, edges);
  return sets;
}

/// (n) area that each point stands for, to scale: that out to its farthest neighbour. Of few points far from all
/// others, which may be strays, no more than `most_of_median` times the usual.
Eigen::VectorXd areas_of(const PointsRef& points, const NeighborsRef& neighbors, double most_of_median = 8) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(points.rows());
  for (Index i = 0; i < neighbors.rows(); ++i) {
    for (Index j : neighbors.row(i)) {
      if (j >= 0) areas(i) = std::max(areas(i), (points.row(j) - points.row(i)).squaredNorm());
    }
  }
  if (areas.size() == 0) return areas;
  Eigen::VectorXd sorted = areas;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  return areas.cwiseMin(most_of_median * sorted(sorted.size() / 2));
}

/// Turns back each connected part of what was turned unless most edges at its border disagree with the normals given:
/// on walls as thin as the points are apart, some do either way.
void turn_back(const PointsRef& points, const PointsRef& given, const NeighborsRef& neighbors, Points& turned) {
  const Index n = points.rows();
  const Mask is_turned = (given.array() * turned.array()).rowwise().sum() < 0;
  DisjointSets parts(n);
  for (Index i = 0; i < n; ++i) {
    for (Index j : neighbors.row(i)) {
      if (j >= 0 && is_turned(i) && is_turned(j)) parts.join(i, j);
    }
  }
  std::vector<Index> edges(static_cast<std::size_t>(n), 0), disagreeing(edges);
  for (Index i = 0; i < n; ++i) {
    for (Index j : neighbors.row(i)) {
      if (j < 0 || is_turned(i) == is_turned(j)) continue;
      const double cosine = carried_cosine(points, given, i, j);
      const Index part = parts.find(is_turned(i) ? i : j);
      edges[part] += std::abs(cosine) > conclusive;
      disagreeing[part] += cosine < -conclusive;
    }
  }
  for (Index i = 0; i < n; ++i) {
    const Index part = parts.find(i);
    const double least = most_of_border * static_cast<double>(std::max(edges[part], fewest_edges));
    if (is_turned(i) && static_cast<double>(disagreeing[part]) <= least) turned.row(i) *= -1;
  }
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
  const Eigen::VectorXd areas = areas_of(points, neighbors);
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
  const Mask is_known = known.size() == n ? Mask(known) : Mask::Constant(n, false);
  Points oriented = normals;
  for (Index i = 0; i < n; ++i) {
    if (is_known(i)) continue;
    // One sign for n and -n, whatever was given.
    Index largest;
    oriented.row(i).cwiseAbs().maxCoeff(&largest);
    if (oriented(i, largest) < 0) oriented.row(i) *= -1;
  }
  SignedSets pieces = joined_by_edges(points, oriented, neighbors, is_known, 0);
  std::vector<Index> piece(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    const auto [root, flipped] = pieces.find(i);
    piece[i] = root;
    if (flipped) oriented.row(i) *= -1;
  }
  std::vector<char> inwards = face_inwards(points, oriented, neighbors, piece);
  // The known ones turn back to the signs that they had.
  for (Index i = 0; i < n; ++i) {
    if (is_known(i)) inwards[piece[i]] = pieces.find(i).second;
  }
  for (Index i = 0; i < n; ++i) {
    if (inwards[piece[i]]) oriented.row(i) *= -1;
  }
  return oriented;
}

Points agree_on_signs(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors, double vote) {
  require(vote > 0, "a vote must count for something");
  require_neighborhoods(points, normals, neighbors);
  const Index n = points.rows();
  SignedSets pieces = joined_by_edges(points, normals, neighbors, Mask::Constant(n, false), vote);
  const bool voters_flipped = pieces.find(n).second;
  Points agreed = normals;
  for (Index i = 0; i < n; ++i) {
    if (pieces.find(i).second != voters_flipped) agreed.row(i) *= -1;
  }
  turn_back(points, normals, neighbors, agreed);
  return agreed;
}

double orientation_consistency(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  require_neighborhoods(points, normals, neighbors);
  Index agree = 0, count = 0;
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index j : neighbors.row(i)) {
      if (j < 0) continue;
      const double cosine = carried_cosine(points, normals, i, j);
      count += std::abs(cosine) > conclusive;
      agree += cosine > conclusive;
    }
  }
  return count == 0 ? 1 : static_cast<double>(agree) / static_cast<double>(count);
}

}  // namespace hdpea
