// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/neighbors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

/// nanoflann's view of a row-major array.
struct Adaptor {
  const CoordinatesRef& points;

  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points.rows()); }
  double kdtree_get_pt(std::size_t row, std::size_t column) const { return points(row, column); }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// The k best by (distance, index), in order: nanoflann's own set breaks ties by the order of its tree.
class NearestSet {
 public:
  using DistanceType = double;
  using Candidate = std::pair<double, Index>;
  explicit NearestSet(std::size_t k) : k_(k) { best_.reserve(k + 1); }

  bool full() const { return best_.size() == k_; }
  /// A little more than the k-th distance, since nanoflann passes on only what is strictly less.
  double worstDist() const { return bound_; }
  bool addPoint(double distance, Index index) {
    const Candidate candidate{distance, index};
    if (full()) {
      if (candidate >= best_.back()) return true;
      best_.pop_back();
    }
    // From the end on: for the few dozens that are asked for, a heap is half as fast.
    std::size_t place = best_.size();
    best_.push_back(candidate);
    for (; place > 0 && best_[place - 1] > candidate; --place) best_[place] = best_[place - 1];
    best_[place] = candidate;
    // Kept, as it is asked for several times as often as it changes.
    if (full()) bound_ = std::nextafter(best_.back().first, std::numeric_limits<double>::infinity());
    return true;
  }
  /// What nanoflann calls at the end of a search from 1.5 on; they are in order.
  void sort() {}
  const std::vector<Candidate>& sorted() const { return best_; }

 private:
  std::size_t k_;
  std::vector<Candidate> best_;
  double bound_ = std::numeric_limits<double>::max();
};

/// A tree in as many dimensions, or, if that is -1, in as many as it is told.
template <int dimensions>
using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    std::conditional_t<dimensions == 3, nanoflann::L2_Simple_Adaptor<double, Adaptor>,
                       nanoflann::L2_Adaptor<double, Adaptor>>,
    Adaptor, dimensions, Index>;

const nanoflann::KDTreeSingleIndexAdaptorParams kLeaves(16);

/// The row's k nearest of `count` points, leaving out `excluded` (-1: nothing is left out).
template <class AnyTree, class Row>
void search(const AnyTree& tree, Index count, const double* query, Index excluded, Row row) {
  const Index wanted = std::min<Index>(row.size(), count);
  NearestSet nearest(static_cast<std::size_t>(wanted) + (excluded >= 0 ? 1 : 0));
  tree.findNeighbors(nearest, query, {});  // options, whose type has another name from nanoflann 1.5 on
  row.setConstant(-1);
  Index filled = 0;
  for (const auto& [distance, index] : nearest.sorted()) {
    if (index != excluded && filled < row.size()) row(filled++) = index;
  }
}

/// Builds a tree of points and hands it to `use`; of known dimensions in the two spaces that surfaces lie in.
template <class Use>
void with_tree(const CoordinatesRef& points, const Use& use) {
  const Adaptor adaptor{points};
  const int dimensions = static_cast<int>(points.cols());
  switch (dimensions) {
    case 3:
      return use(Tree<3>(dimensions, adaptor, kLeaves));
    case 8:
      return use(Tree<8>(dimensions, adaptor, kLeaves));
    default:
      return use(Tree<-1>(dimensions, adaptor, kLeaves));
  }
}

void check(const CoordinatesRef& points, Index k) {
  require_finite(points, "points");
  require(k >= 1, "the number of neighbours must be at least 1");
  require(points.rows() >= 1 && points.cols() >= 1, "nearest_neighbors needs at least one point");
}

}  // namespace

Neighbors nearest_neighbors(const CoordinatesRef& points, const CoordinatesRef& queries, Index k) {
  check(points, k);
  require(points.cols() == queries.cols(), "points and queries must have the same dimension");
  require_finite(queries, "queries");
  Neighbors neighbors(queries.rows(), k);
  with_tree(points, [&](const auto& tree) {
    parallel_for(queries.rows(),
                 [&](Index i) { search(tree, points.rows(), queries.row(i).data(), -1, neighbors.row(i)); });
  });
  return neighbors;
}

Neighbors nearest_neighbors(const CoordinatesRef& points, Index k) {
  check(points, k);
  Neighbors neighbors(points.rows(), k);
  with_tree(points, [&](const auto& tree) {
    parallel_for(points.rows(),
                 [&](Index i) { search(tree, points.rows(), points.row(i).data(), i, neighbors.row(i)); });
  });
  return neighbors;
}

struct NearestPoints::Search {
  explicit Search(const PointsRef& given) : points(given), tree(3, adaptor, kLeaves) {}

  const CoordinatesRef points;
  const Adaptor adaptor{points};
  const Tree<3> tree;
};

NearestPoints::NearestPoints(const PointsRef& points) {
  check(points, 1);
  search_ = std::make_unique<Search>(points);
}

NearestPoints::~NearestPoints() = default;

Eigen::Vector<Index, Eigen::Dynamic> NearestPoints::to(const PointsRef& places) const {
  require_finite(places, "places");
  Neighbors nearest(places.rows(), 1);
  parallel_for(places.rows(), [&](Index i) {
    search(search_->tree, search_->points.rows(), places.row(i).data(), -1, nearest.row(i));
  });
  return nearest.col(0);
}

}  // namespace hdpea
