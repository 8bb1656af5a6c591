// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/sheets.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

constexpr Index kAround = 16;  // neighbours that should surround a point inside its sheet

/// Whether the point's own sheet leaves a gap of at least `rim_gap` degrees around it.
bool is_rim(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors, Index i,
            const SheetOptions& options, std::vector<double>& angles) {
  const Eigen::Vector3d normal = normals.row(i).transpose();
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  angles.clear();
  for (Index j : neighbors.row(i)) {
    if (j < 0 || normals.row(i).dot(normals.row(j)) < options.min_cosine) continue;
    const Eigen::Vector3d offset = (points.row(j) - points.row(i)).transpose();
    angles.push_back(std::atan2(offset.dot(v), offset.dot(u)));
    if (static_cast<Index>(angles.size()) == kAround) break;
  }
  if (angles.empty()) return true;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t a = 1; a < angles.size(); ++a) widest = std::max(widest, angles[a] - angles[a - 1]);
  return widest * 180 / std::numbers::pi >= options.rim_gap;
}

/// Whether j lies above or below i rather than beside it, by more than `gap`, as seen along both normals.
bool is_stacked(const PointsRef& points, const PointsRef& normals, Index i, Index j, double gap,
                const SheetOptions& options) {
  const Eigen::RowVector3d offset = points.row(j) - points.row(i);
  const double height = std::min(std::abs(offset.dot(normals.row(i))), std::abs(offset.dot(normals.row(j))));
  return height > gap && height > options.max_slope * offset.norm();
}

double third_distance(const PointsRef& points, const NeighborsRef& neighbors, Index i) {
  Index last = i;
  for (Index at = 0; at < std::min<Index>(3, neighbors.cols()) && neighbors(i, at) >= 0; ++at) last = neighbors(i, at);
  return (points.row(last) - points.row(i)).norm();
}

}  // namespace

Neighbors sheet_neighbors(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
                          const SheetOptions& options) {
  const Index n = points.rows();
  require_neighborhoods(points, normals, neighbors);
  require_directions(normals, "normals");
  std::vector<char> rim(static_cast<std::size_t>(n));
  std::vector<double> reach(static_cast<std::size_t>(n));
  parallel_for(n, [&](Index i) {
    thread_local std::vector<double> angles;
    rim[i] = is_rim(points, normals, neighbors, i, options, angles);
    reach[i] = options.rim_distance * third_distance(points, neighbors, i);
  });
  Neighbors kept = Neighbors::Constant(n, neighbors.cols(), -1);
  parallel_for(n, [&](Index i) {
    Index count = 0;
    for (Index j : neighbors.row(i)) {
      if (j < 0) continue;
      const bool agree = normals.row(i).dot(normals.row(j)) >= options.min_cosine &&
                         !is_stacked(points, normals, i, j, std::min(reach[i], reach[j]), options);
      const bool meet = rim[i] && rim[j] && (points.row(j) - points.row(i)).norm() <= std::max(reach[i], reach[j]);
      if (agree || meet) kept(i, count++) = j;
    }
  });
  return kept;
}

Points blended_normals(const PointsRef& normals, const NeighborsRef& sheet_neighbors, Index count) {
  require_finite(normals, "normals");
  require_neighbors(sheet_neighbors, normals.rows());
  require(count >= 0, "the number of neighbours must be 0 or more");
  Points blended(normals.rows(), 3);
  parallel_for(normals.rows(), [&](Index i) {
    Eigen::RowVector3d sum = normals.row(i);
    for (Index at = 0; at < std::min(count, sheet_neighbors.cols()) && sheet_neighbors(i, at) >= 0; ++at) {
      sum += normals.row(sheet_neighbors(i, at));
    }
    // Normals that cancel have no bisector.
    blended.row(i) = sum.norm() > 0.1 ? Eigen::RowVector3d(sum.normalized()) : Eigen::RowVector3d(normals.row(i));
  });
  return blended;
}

}  // namespace hdpea
