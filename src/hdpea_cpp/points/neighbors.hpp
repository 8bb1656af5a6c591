// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// The k nearest of `points` to each of `queries`, in R^d.
///
/// Rows are sorted by (distance, index), so equal distances cannot make the result depend on the
/// order of a tree. A query that is itself one of the points finds itself first (or an earlier duplicate).
///
/// @param points   (n, d), n >= 1, finite
/// @param queries  (m, d), finite
/// @param k        how many; rows are padded with -1 where n < k
/// @throws InvalidArgument if k < 1, n < 1 or the dimensions differ
Neighbors nearest_neighbors(const CoordinatesRef& points, const CoordinatesRef& queries, Index k);

/// The k nearest *other* points of each point: as above, without the point itself.
Neighbors nearest_neighbors(const CoordinatesRef& points, Index k);

/// Finds the nearest of some points in R^3 again and again, by one tree.
class NearestPoints {
 public:
  /// @param points  (n, 3), n >= 1, finite; not copied
  /// @throws InvalidArgument if there is no point, or one is not finite
  explicit NearestPoints(const PointsRef& points);
  ~NearestPoints();
  NearestPoints(const NearestPoints&) = delete;
  NearestPoints& operator=(const NearestPoints&) = delete;

  /// The nearest point to each of finite places (m, 3); of equally near ones the first.
  Eigen::Vector<Index, Eigen::Dynamic> to(const PointsRef& places) const;

 private:
  struct Search;
  std::unique_ptr<const Search> search_;
};

}  // namespace hdpea
