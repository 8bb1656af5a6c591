// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/crease_edges.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hdpea_cpp/base/angles.hpp"
#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/mesh/flippable_mesh.hpp"
#include "hdpea_cpp/points/creases_nearby.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::RowVector3d;

/// Of an edge along a crease: the least angle between its faces and the most to the crease, in degrees, and the
/// farthest that its middle lies off, in spacings.
constexpr double kSharp = 30, kTurned = 20, kOff = 0.5;

/// The half-edges of lower index of all edges with at least the least angle between their faces.
std::vector<Index> sharp_edges(const PointsRef& vertices, const FlippableMesh& mesh) {
  const auto at = [&](Index v) { return Vector(vertices.row(v)); };
  const auto normal = [&](Index h) {
    return area_vector(at(mesh.source(h)), at(mesh.target(h)), at(mesh.apex(h))).normalized();
  };
  std::vector<Index> sharp;
  for (Index h = 0; h < mesh.halfedges(); ++h) {
    const Index o = mesh.opposite(h);
    if (o > h && normal(h).dot(normal(o)) < cosine_of(kSharp)) sharp.push_back(h);
  }
  return sharp;
}

/// Whether an edge from its middle to an end runs along the crease at a sample.
bool runs_along(const CreasesNearby& creases, Index s, const Vector& middle, const Vector& half) {
  return creases.covers(s, middle) && creases.distance(s, middle) <= kOff * creases.spacing(s) &&
         std::abs(creases.direction(s).dot(half)) >= cosine_of(kTurned) * half.norm();
}

}  // namespace

Edges crease_edges(const PointsRef& vertices, const FacesRef& faces, const Creases& creases) {
  require_mesh(vertices, faces);
  if (creases.samples.empty() || faces.rows() == 0) return Edges(0, 2);
  const CreasesNearby nearby(creases);
  const FlippableMesh mesh(faces, vertices.rows());
  const std::vector<Index> sharp = sharp_edges(vertices, mesh);
  Points middles(static_cast<Index>(sharp.size()), 3);
  for (Index e = 0; e < middles.rows(); ++e) {
    middles.row(e) = (vertices.row(mesh.source(sharp[e])) + vertices.row(mesh.target(sharp[e]))) / 2;
  }
  const Neighbors near = nearby.near(middles);
  Edges edges(middles.rows(), 2);
  Index along = 0;
  for (Index e = 0; e < middles.rows(); ++e) {
    const Vector middle = middles.row(e), half = vertices.row(mesh.target(sharp[e])) - middle;
    const auto holds = [&](Index s) { return s >= 0 && runs_along(nearby, s, middle, half); };
    if (!std::any_of(near.row(e).begin(), near.row(e).end(), holds)) continue;
    edges.row(along++) << mesh.source(sharp[e]), mesh.target(sharp[e]);
  }
  edges.conservativeResize(along, 2);
  return edges;
}

}  // namespace hdpea
