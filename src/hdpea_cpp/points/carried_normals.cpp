// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/carried_normals.hpp"

#include <algorithm>

namespace hdpea {

double carried_cosine(const PointsRef& points, const PointsRef& normals, Index i, Index j) {
  const Eigen::RowVector3d edge = (points.row(j) - points.row(i)).stableNormalized();
  const Eigen::RowVector3d normal = normals.row(i);
  return (normal - 2 * normal.dot(edge) * edge).dot(normals.row(j));
}

Eigen::VectorXd neighborhood_areas(const PointsRef& points, const NeighborsRef& neighbors) {
  constexpr double most_of_median = 8;
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

}  // namespace hdpea
