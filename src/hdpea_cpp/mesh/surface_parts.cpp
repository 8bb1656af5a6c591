// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/surface_parts.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {
namespace {

// Points whose normal agrees less with their face's belong to another sheet.
constexpr double kLeastCosine = 0.3;

Eigen::Matrix4d plane_quadric(const Eigen::Vector3d& normal, const Eigen::Vector3d& on, double weight) {
  Eigen::Vector4d plane;
  plane << normal, -normal.dot(on);
  return weight * plane * plane.transpose();
}

double triangle_area(const CoordinatesRef& coordinates, Index a, Index b, Index c) {
  const Eigen::VectorXd u = coordinates.row(b) - coordinates.row(a), v = coordinates.row(c) - coordinates.row(a);
  return std::sqrt(std::max(0.0, u.squaredNorm() * v.squaredNorm() - std::pow(u.dot(v), 2))) / 2;
}

/// Adds the planes of the points to the corners of their faces; each face's area is shared by its points.
/// Returns how many each face has.
std::vector<Index> add_points(const Points& area_vectors, const FacesRef& faces, const PointsRef& points,
                              const PointsRef& normals, const SurfacePoints& feet, std::vector<SurfacePart>& parts) {
  const auto agrees = [&](Index p) {
    const auto area = area_vectors.row(feet.face(p));
    return normals.row(p).dot(area) >= kLeastCosine * area.norm();
  };
  std::vector<Index> count(static_cast<std::size_t>(faces.rows()), 0);
  for (Index p = 0; p < points.rows(); ++p) count[feet.face(p)] += agrees(p) ? 1 : 0;
  for (Index p = 0; p < points.rows(); ++p) {
    if (!agrees(p)) continue;
    const Index f = feet.face(p);
    const double weight = area_vectors.row(f).norm() / 2 / static_cast<double>(count[f]);
    const Eigen::Matrix4d quadric = plane_quadric(normals.row(p), points.row(p), weight);
    for (int i = 0; i < 3; ++i) parts[faces(f, i)].quadric += feet.barycentric(p, i) * quadric;
  }
  return count;
}

void add_borders(const PointsRef& vertices, const FacesRef& faces, double border, std::vector<SurfacePart>& parts) {
  std::map<std::pair<Index, Index>, Index> apex;
  for (Index f = 0; f < faces.rows(); ++f) {
    for (int i = 0; i < 3; ++i) apex[{faces(f, i), faces(f, (i + 1) % 3)}] = faces(f, (i + 2) % 3);
  }
  for (const auto& [edge, opposite] : apex) {
    const auto [from, to] = edge;
    if (apex.contains({to, from})) continue;
    const Eigen::Vector3d a = vertices.row(from), along = vertices.row(to).transpose() - a,
                          inward = vertices.row(opposite).transpose() - a;
    // The plane that holds the edge and stands upright on its face.
    const Eigen::Vector3d across = along.cross(along.cross(inward)).normalized();
    const Eigen::Matrix4d quadric = plane_quadric(across, a, border * along.squaredNorm());
    parts[from].quadric += quadric;
    parts[to].quadric += quadric;
  }
}

}  // namespace

double SurfacePart::squared_distance(const Eigen::Vector3d& at) const {
  const Eigen::Vector4d place = at.homogeneous();
  return std::max(0.0, place.dot(quadric * place));
}

SurfacePart joined(const SurfacePart& a, const SurfacePart& b) {
  const double area = a.area + b.area, share = area > 0 ? b.area / area : 0.5;
  return {a.quadric + b.quadric, area, a.centroid + share * (b.centroid - a.centroid)};
}

double variance_growth(const SurfacePart& a, const SurfacePart& b) {
  const double area = a.area + b.area;
  return area > 0 ? a.area * b.area / area * (a.centroid - b.centroid).squaredNorm() : 0;
}

Eigen::Vector3d nearest_to_planes(const SurfacePart& part, const Eigen::Vector3d& middle, double pull) {
  Eigen::Matrix3d matrix = part.quadric.topLeftCorner<3, 3>();
  const double weight = pull * matrix.trace();
  if (!(weight > 0)) return middle;
  matrix.diagonal().array() += weight;
  const Eigen::Vector3d right = weight * middle - part.quadric.topRightCorner<3, 1>();
  return matrix.ldlt().solve(right);
}

std::vector<SurfacePart> parts_of(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                                  const PointsRef& points, const PointsRef& normals, double border) {
  std::vector<SurfacePart> parts(static_cast<std::size_t>(vertices.rows()));
  for (Index v = 0; v < vertices.rows(); ++v) parts[v].centroid = coordinates.row(v).transpose();
  Points area_vectors(faces.rows(), 3);
  for (Index f = 0; f < faces.rows(); ++f) {
    area_vectors.row(f) = area_vector(vertices.row(faces(f, 0)), vertices.row(faces(f, 1)), vertices.row(faces(f, 2)));
  }
  std::vector<Index> count(static_cast<std::size_t>(faces.rows()), 0);
  if (points.rows() > 0 && faces.rows() > 0) {
    count = add_points(area_vectors, faces, points, normals, closest_surface_points(vertices, faces, points), parts);
  }
  for (Index f = 0; f < faces.rows(); ++f) {
    const double area = triangle_area(coordinates, faces(f, 0), faces(f, 1), faces(f, 2));
    const Eigen::Vector3d normal = area_vectors.row(f);
    const double weight = count[f] == 0 ? normal.norm() / 6 : 0;
    const Eigen::Matrix4d quadric = plane_quadric(normal.normalized(), vertices.row(faces(f, 0)), weight);
    for (Index v : faces.row(f)) {
      parts[v].quadric += quadric;
      parts[v].area += area / 3;
    }
  }
  add_borders(vertices, faces, border, parts);
  return parts;
}

}  // namespace hdpea
