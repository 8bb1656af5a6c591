// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/changes_taken_back.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {
namespace {

using Corners = std::array<Index, 3>;
using Place = std::array<double, 3>;

Place place(const PointsRef& vertices, Index v) { return {vertices(v, 0), vertices(v, 1), vertices(v, 2)}; }

/// From the smallest corner on.
Corners turned(Corners face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

/// The corners of faces as rows of the given vertices, or, where they are at none of these, as rows of their own
/// vertices after them.
std::vector<Corners> corners_among(const PointsRef& given, const PointsRef& vertices, const FacesRef& faces) {
  std::map<Place, Index> row_at;
  for (Index v = 0; v < given.rows(); ++v) row_at.emplace(place(given, v), v);
  std::vector<Index> row(static_cast<std::size_t>(vertices.rows()));
  for (Index v = 0; v < vertices.rows(); ++v) {
    const auto found = row_at.find(place(vertices, v));
    row[v] = found == row_at.end() ? given.rows() + v : found->second;
  }
  std::vector<Corners> corners;
  for (Index f = 0; f < faces.rows(); ++f)
    corners.push_back(turned({row[faces(f, 0)], row[faces(f, 1)], row[faces(f, 2)]}));
  return corners;
}

/// The faces, and those vertices that they have.
TriangleMesh compact(const PointsRef& vertices, const Points& more_vertices, const std::vector<Corners>& faces) {
  std::vector<Index> row(static_cast<std::size_t>(vertices.rows() + more_vertices.rows()), -1);
  for (const Corners& face : faces) {
    for (Index v : face) row[v] = 0;
  }
  Index rows = 0;
  for (Index& r : row) r = r < 0 ? -1 : rows++;
  TriangleMesh mesh{Points(rows, 3), Faces(static_cast<Index>(faces.size()), 3)};
  for (Index v = 0; v < static_cast<Index>(row.size()); ++v) {
    if (row[v] < 0) continue;
    if (v < vertices.rows()) {
      mesh.vertices.row(row[v]) = vertices.row(v);
    } else {
      mesh.vertices.row(row[v]) = more_vertices.row(v - vertices.rows());
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    mesh.faces.row(static_cast<Index>(f)) << row[faces[f][0]], row[faces[f][1]], row[faces[f][2]];
  }
  return mesh;
}

}  // namespace

TriangleMesh with_losses_taken_back(const PointsRef& vertices, const FacesRef& faces, const TriangleMesh& changed,
                                    const PointsRef& points, double farthest) {
  const std::vector<Corners> before = corners_among(vertices, vertices, faces),
                             after = corners_among(vertices, changed.vertices, changed.faces);
  const std::set<Corners> all_before(before.begin(), before.end()), all_after(after.begin(), after.end());
  const auto stayed = [&](const Corners& face) { return all_before.contains(face) && all_after.contains(face); };

  DisjointSets changes(vertices.rows() + changed.vertices.rows());
  for (const auto* mesh : {&before, &after}) {
    for (const Corners& face : *mesh) {
      if (stayed(face)) continue;
      changes.join(face[0], face[1]);
      changes.join(face[0], face[2]);
    }
  }

  const SurfacePoints feet = closest_surface_points(vertices, faces, points);
  std::vector<Index> concerned;
  for (Index p = 0; p < points.rows(); ++p) {
    if (!stayed(before[feet.face(p)])) concerned.push_back(p);
  }
  const Points moved = points(concerned, Eigen::all);
  const Eigen::VectorXd distances = closest_surface_points(changed.vertices, changed.faces, moved).distance;
  const Index names = vertices.rows() + changed.vertices.rows();
  Eigen::VectorXd most_before = Eigen::VectorXd::Constant(names, farthest), most_after = Eigen::VectorXd::Zero(names);
  for (Index i = 0; i < moved.rows(); ++i) {
    const Index change = changes.find(before[feet.face(concerned[i])][0]);
    most_before(change) = std::max(most_before(change), feet.distance(concerned[i]));
    most_after(change) = std::max(most_after(change), distances(i));
  }

  const auto taken_back = [&](const Corners& face) {
    const Index change = changes.find(face[0]);
    return most_after(change) > most_before(change);
  };
  std::vector<Corners> kept;
  for (const Corners& face : before) {
    if (stayed(face) || taken_back(face)) kept.push_back(face);
  }
  for (const Corners& face : after) {
    if (!stayed(face) && !taken_back(face)) kept.push_back(face);
  }
  return compact(vertices, changed.vertices, kept);
}

}  // namespace hdpea
