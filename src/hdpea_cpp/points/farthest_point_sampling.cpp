// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/farthest_point_sampling.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {
namespace {

constexpr Index leaf_size = 16;
constexpr Index samples_per_report = 1024;
/// Below every real distance, so that a sample is never taken again.
constexpr double sampled = -1;

/// A kd-tree that knows, for each box, its point farthest from the samples so far.
/// Points are renumbered so that a box is a range; `index_` leads back.
class FarthestTree {
 public:
  explicit FarthestTree(const CoordinatesRef& points) : index_(points.rows()), distance_(points.rows()) {
    std::iota(index_.begin(), index_.end(), Index{0});
    std::fill(distance_.begin(), distance_.end(), std::numeric_limits<double>::infinity());
    build(points, 0, points.rows());
    points_ = points(index_, Eigen::all);
  }

  /// Of each of these indices.
  std::vector<Index> positions(const std::vector<Index>& indices) const {
    std::vector<Index> position(index_.size()), found;
    for (std::size_t p = 0; p < index_.size(); ++p) position[index_[p]] = static_cast<Index>(p);
    for (Index index : indices) found.push_back(position[index]);
    return found;
  }
  bool is_sample(Index position) const { return distance_[position] == sampled; }
  Index index(Index position) const { return index_[position]; }
  Index farthest() const { return nodes_[0].farthest; }

  void add_sample(Index position) {
    sample_ = position;
    distance_[position] = sampled;
    update(0);
  }

 private:
  struct Node {
    Index begin, end;
    /// The left child follows its parent; 0 means a leaf.
    Index right = 0;
    Index farthest;
    Eigen::RowVectorXd low, high;
  };

  Index build(const CoordinatesRef& points, Index begin, Index end) {
    const Index id = static_cast<Index>(nodes_.size());
    const auto rows = points(std::vector<Index>(index_.begin() + begin, index_.begin() + end), Eigen::all);
    nodes_.push_back({begin, end, 0, begin, rows.colwise().minCoeff(), rows.colwise().maxCoeff()});
    if (end - begin > leaf_size) {
      Index axis = 0;
      (nodes_[id].high - nodes_[id].low).maxCoeff(&axis);
      const Index middle = (begin + end) / 2;
      std::nth_element(index_.begin() + begin, index_.begin() + middle, index_.begin() + end,
                       [&](Index i, Index j) { return points(i, axis) < points(j, axis); });
      build(points, begin, middle);
      nodes_[id].right = build(points, middle, end);
    }
    return id;
  }

  bool farther(Index a, Index b) const {
    return distance_[a] != distance_[b] ? distance_[a] > distance_[b] : index_[a] < index_[b];
  }

  /// Summed in the same order as `lower_leaf` does, so that rounding keeps it a lower bound.
  double squared_distance_to_box(const Node& node) const {
    double sum = 0;
    for (Index c = 0; c < points_.cols(); ++c) {
      const double x = points_(sample_, c);
      const double gap = std::max({node.low(c) - x, x - node.high(c), 0.0});
      sum += gap * gap;
    }
    return sum;
  }

  void lower_leaf(Node& node) {
    node.farthest = node.begin;
    for (Index i = node.begin; i < node.end; ++i) {
      double sum = 0;
      for (Index c = 0; c < points_.cols(); ++c) {
        const double gap = points_(i, c) - points_(sample_, c);
        sum += gap * gap;
      }
      distance_[i] = std::min(distance_[i], sum);
      if (farther(i, node.farthest)) node.farthest = i;
    }
  }

  void update(Index id) {
    Node& node = nodes_[id];
    const bool holds_sample = node.begin <= sample_ && sample_ < node.end;
    if (!holds_sample && squared_distance_to_box(node) >= distance_[node.farthest]) return;
    if (node.right == 0) return lower_leaf(node);
    update(id + 1);
    update(node.right);
    const Index left = nodes_[id + 1].farthest, right = nodes_[node.right].farthest;
    node.farthest = farther(left, right) ? left : right;
  }

  std::vector<Index> index_;
  std::vector<double> distance_;
  std::vector<Node> nodes_;
  Coordinates points_;
  Index sample_ = 0;
};

}  // namespace

Eigen::Vector<Index, Eigen::Dynamic> farthest_point_sampling(const CoordinatesRef& points, Index count,
                                                             const std::vector<Index>& first,
                                                             const Progress& progress) {
  require(points.cols() >= 1, "points must have at least one coordinate");
  require(count >= 1 && count <= points.rows(), "the number of samples must lie between 1 and the number of points");
  require_finite(points, "points");
  require(!first.empty() && static_cast<Index>(first.size()) <= count, "there must be 1 to `count` first samples");
  for (Index each : first) require(each >= 0 && each < points.rows(), "the first samples must be among the points");
  FarthestTree tree(points);
  Eigen::Vector<Index, Eigen::Dynamic> samples(count);
  const std::vector<Index> given = tree.positions(first);
  for (Index i = 0; i < count; ++i) {
    if (i % samples_per_report == 0) report(progress, static_cast<double>(i) / static_cast<double>(count));
    const Index position = i < static_cast<Index>(given.size()) ? given[i] : tree.farthest();
    require(!tree.is_sample(position), "the first samples must all be different");
    samples(i) = tree.index(position);
    tree.add_sample(position);
  }
  report(progress, 1);
  return samples;
}

}  // namespace hdpea
