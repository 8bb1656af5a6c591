// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/point_guard.hpp"

#include <algorithm>
#include <limits>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/triangle_distance.hpp"

namespace hdpea {
namespace {

using Vertex = PointGuard::Vertex;
using Halfedge = SurfaceMesh::Halfedge_index;

/// Least cosine between a face and the normals of its points, unless it was less before.
constexpr double kUpright = 0.5;

/// By how much more than now a step may take points from the faces, in squared distances.
constexpr double kWorse = 1.1;

/// What points may be from the faces whatever they were before, in squared distances. All of a vertex together: so many
/// times the mean, as long as that is no more than so small a share of the spacing of the vertices, or else the mean.
/// (Four times it takes a sixth more off the accuracy of lattice_lamp; the mean itself leaves goat_head at G 0.72
/// instead of 0.76, and a sphere less even.) A single one: so many times the mean, as the rim of a thin wall is few
/// points among many, and would retreat by their sum alone.
constexpr double kTogether = 4, kNear = 0.03, kAlone = 30;

/// Mean squared distance, for the squared spacing of the vertices, that exact points count as having: what is flat
/// stays flat but for rounding, which must not hold its vertices.
constexpr double kExact = 1e-6;

}  // namespace

PointGuard::PointGuard(const SurfaceMesh& mesh, const Points& positions, const VertexCells& cells,
                       const EmbeddedCloud& cloud)
    : mesh_(mesh), positions_(positions), cells_(cells), cloud_(cloud) {
  double sum = 0;
  for (const Vertex v : mesh.vertices()) sum += mesh.is_isolated(v) ? 0 : squared_distances({&v, 1}).sum;
  const double squared_spacing = area() / static_cast<double>(positions.rows());
  const double mean = std::max(sum / static_cast<double>(cloud.coordinates.rows()), kExact * squared_spacing);
  together_ = std::max(mean, std::min(kTogether * mean, kNear * kNear * squared_spacing));
  alone_ = std::max(kAlone * mean, kNear * kNear * squared_spacing);
}

PointGuard::SquaredDistances PointGuard::squared_distances(std::span<const Vertex> vertices) const {
  SquaredDistances found;
  for (const Vertex v : vertices) {
    for (const Index point : cells_.points(v.idx())) {
      const double squared = squared_distance_from_ring(point, v);
      found.sum += squared;
      found.largest = std::max(found.largest, squared);
    }
  }
  return found;
}

PointGuard::SquaredDistances PointGuard::allowed(std::span<const Vertex> vertices) const {
  double points = 0;
  for (const Vertex v : vertices) points += static_cast<double>(cells_.points(v.idx()).size());
  const SquaredDistances now = squared_distances(vertices);
  return {std::max(kWorse * now.sum, together_ * points), std::max(kWorse * now.largest, alone_)};
}

bool PointGuard::may_cover(Index point, Vertex v) const { return squared_distance_from_ring(point, v) <= alone_; }

bool PointGuard::stays_upright(double uprightness, double before) { return uprightness >= std::min(kUpright, before); }

double PointGuard::uprightness(Vertex a, Vertex b, Vertex c) const {
  const Eigen::RowVector3d normals =
      cells_.planes(a.idx()).normals + cells_.planes(b.idx()).normals + cells_.planes(c.idx()).normals;
  const double length = normals.norm();
  return length > 0 ? unit_normal(a, b, c).dot(normals) / length : 1;
}

double PointGuard::uprightness(Vertex v) const {
  double least = 1;
  for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
    if (!mesh_.is_border(h)) least = std::min(least, uprightness(mesh_.source(h), v, mesh_.target(mesh_.next(h))));
  }
  return least;
}

Eigen::RowVector3d PointGuard::unit_normal(Vertex a, Vertex b, Vertex c) const {
  return area_vector(positions_.row(a.idx()), positions_.row(b.idx()), positions_.row(c.idx())).normalized();
}

double PointGuard::squared_distance_from_ring(Index point, Vertex v) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
    if (mesh_.is_border(h)) continue;
    least = std::min(least, squared_distance_from_triangle(cloud_.position(point), positions_.row(v.idx()),
                                                           positions_.row(mesh_.target(mesh_.next(h)).idx()),
                                                           positions_.row(mesh_.source(h).idx())));
  }
  return least;
}

double PointGuard::area(SurfaceMesh::Face_index face) const {
  const Halfedge h = mesh_.halfedge(face);
  return area_vector(positions_.row(mesh_.target(h).idx()), positions_.row(mesh_.target(mesh_.next(h)).idx()),
                     positions_.row(mesh_.source(h).idx()))
             .norm() /
         2;
}

double PointGuard::area() const {
  double sum = 0;
  for (const auto f : mesh_.faces()) sum += area(f);
  return sum;
}

}  // namespace hdpea
