// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/vertex_cells.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {

Coordinate EmbeddedCloud::projected(const Coordinate& x, Index point) const {
  const Coordinate base = coordinates.row(point), apart = x - base;
  const auto u = bases.row(point).head(x.size()), v = bases.row(point).tail(x.size());
  return base + apart.dot(u) * u + apart.dot(v) * v;
}

void require_embedded(const EmbeddedCloud& cloud) {
  const Index count = cloud.coordinates.rows(), dimensions = cloud.coordinates.cols();
  require(count >= 1, "the embedded surface must have at least one point");
  require(dimensions >= 3 && dimensions <= kMostDimensions, "an embedding must have 3 to 16 dimensions");
  require_finite(cloud.coordinates, "the cloud's coordinates", kLargestToTheFourth);
  require_rows(cloud.bases, count, "bases");
  require(cloud.bases.cols() == 2 * dimensions, "bases must have two vectors for each point");
  require_finite(cloud.bases, "bases", kLargestToTheFourth);
  require_rows(cloud.normals, count, "normals");
  require_finite(cloud.normals, "normals", kLargestToTheFourth);
}

void PlaneQuadric::add(const Eigen::RowVector3d& normal, const Eigen::RowVector3d& on) {
  const double offset = normal.dot(on);
  matrix.noalias() += normal.transpose() * normal;
  right += offset * normal.transpose();
  constant += offset * offset;
  normals += normal;
  count += 1;
}

double PlaneQuadric::mean(const Eigen::RowVector3d& at) const {
  if (count == 0) return 0;
  const Eigen::Vector3d x = at.transpose();
  return std::max(0.0, x.dot(matrix * x - 2 * right) + constant) / count;
}

Eigen::RowVector3d PlaneQuadric::least(const Eigen::RowVector3d& goal, double pull) const {
  if (count == 0) return goal;
  Eigen::Matrix3d sum = matrix / count;
  sum.diagonal().array() += pull;
  return sum.ldlt().solve(right / count + pull * goal.transpose()).transpose();
}

VertexCells::VertexCells(const EmbeddedCloud& cloud, const Coordinates& sites, const PointsRef& vertices,
                         const FacesRef& faces)
    : cloud_(cloud), owner_(cloud.coordinates.rows()), points_(static_cast<std::size_t>(sites.rows())) {
  const SurfacePoints feet = closest_surface_points(vertices, faces, cloud.coordinates.leftCols<3>());
  // By the weights: where the closest place lies on an edge, rounding chooses the face, but no weight.
  for (Index point = 0; point < owner_.size(); ++point) {
    Index heaviest;
    feet.barycentric.row(point).maxCoeff(&heaviest);
    owner_(point) = faces(feet.face(point), heaviest);
  }
  gather();
}

void VertexCells::update(const Coordinates& sites, const Neighborhood& neighbors_of, const Covering& may_cover) {
  parallel_for(owner_.size(), [&](Index point) {
    const auto x = cloud_.coordinates.row(point);
    Index best = owner_(point), from = -1;
    double least = (sites.row(best) - x).squaredNorm();
    while (best != from) {
      from = best;
      neighbors_of(from, [&](Index neighbor) {
        const double distance = (sites.row(neighbor) - x).squaredNorm();
        if (distance < least && may_cover(point, neighbor)) least = distance, best = neighbor;
      });
    }
    owner_(point) = best;
  });
  gather();
}

void VertexCells::gather() {
  planes_.assign(points_.size(), {});
  for (std::vector<Index>& points : points_) points.clear();
  for (Index point = 0; point < owner_.size(); ++point) {
    points_[owner_(point)].push_back(point);
    planes_[owner_(point)].add(cloud_.normals.row(point), cloud_.position(point));
  }
}

}  // namespace hdpea
