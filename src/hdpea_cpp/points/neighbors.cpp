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

/// The k best by (distance, index): nanoflann's own set breaks ties by the order of its tree.
class NearestSet {
 public:
  using DistanceType = double;
  using Candidate = std::pair<double, Index>;
  explicit NearestSet(std::size_t k) : k_(k) { best_.reserve(k + 1); }

  bool full() const { return best_.size() == k_; }
  /// A little more than the k-th distance, since nanoflann passes on only what is strictly less.
  double worstDist() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return full() ? std::nextafter(best_.front().first, infinity) : std::numeric_limits<double>::max();
  }
  bool addPoint(double distance, Index index) {
    const Candidate candidate{distance, index};
    if (full() && candidate >= best_.front()) return true;
    best_.push_back(candidate);
    std::push_heap(best_.begin(), best_.end());
    if (best_.size() <= k_) return true;
    std::pop_heap(best_.begin(), best_.end());
    best_.pop_back();
    return true;
  }
  /// What nanoflann calls at the end of a search from 1.5 on; sorted() is enough.
  void sort() {}
  /// The candidates from the best on; no more can be added then.
  const std::vector<Candidate>& sorted() {
    std::sort_heap(best_.begin(), best_.end());
    return best_;
  }

 private:
  std::size_t k_;
  std::vector<Candidate> best_;  // a heap, the worst in front
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Adaptor<double, Adaptor>, Adaptor, -1, Index>;

/// The row's k nearest of `count` points, leaving out `excluded` (-1: nothing is left out).
template <class Row>
void search(const Tree& tree, Index count, const double* query, Index excluded, Row row) {
  thread_local std::vector<Index> found;
  const Index wanted = std::min<Index>(row.size(), count);
  NearestSet nearest(static_cast<std::size_t>(wanted) + (excluded >= 0 ? 1 : 0));
  tree.findNeighbors(nearest, query, {});  // options, whose type has another name from nanoflann 1.5 on
  found.clear();
  for (const auto& [distance, index] : nearest.sorted()) {
    if (index != excluded) found.push_back(index);
  }
  row.setConstant(-1);
  const Index filled = std::min<Index>(row.size(), static_cast<Index>(found.size()));
  for (Index i = 0; i < filled; ++i) row(i) = found[i];
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
  const Adaptor adaptor{points};
  const Tree tree(static_cast<int>(points.cols()), adaptor);
  Neighbors neighbors(queries.rows(), k);
  parallel_for(queries.rows(),
               [&](Index i) { search(tree, points.rows(), queries.row(i).data(), -1, neighbors.row(i)); });
  return neighbors;
}

Neighbors nearest_neighbors(const CoordinatesRef& points, Index k) {
  check(points, k);
  const Adaptor adaptor{points};
  const Tree tree(static_cast<int>(points.cols()), adaptor);
  Neighbors neighbors(points.rows(), k);
  parallel_for(points.rows(), [&](Index i) { search(tree, points.rows(), points.row(i).data(), i, neighbors.row(i)); });
  return neighbors;
}

}  // namespace hdpea
