// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/simplification.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/edge_collapses.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {
namespace {

constexpr Index kCollapsesPerReport = 100;

/// Until all points are within the error, edges are collapsed in at most so many rounds, with so many of splits
/// between.
constexpr int kRounds = 4, kSplits = 5;
/// A point with less than this of the weight of a corner splits the edge across from it.
constexpr double kNearEdge = 0.15;

Index excess(const EditableMesh& mesh, const MeshBudget& budget) {
  return std::max(mesh.vertices_left() - budget.vertices, mesh.faces_left() - budget.faces);
}

SimplifiedMesh arrays_of(const EditableMesh& mesh, const std::vector<SurfacePart>& parts) {
  TriangleMesh simplified = mesh.mesh();
  const std::vector<Index> left = mesh.left();
  Coordinates centroids(simplified.vertices.rows(), parts.empty() ? 0 : parts.front().centroid.size());
  for (Index row = 0; row < centroids.rows(); ++row) centroids.row(row) = parts[left[row]].centroid.transpose();
  return {std::move(simplified.vertices), std::move(centroids), std::move(simplified.faces)};
}

void check_contract(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                    const PointsRef& points, const PointsRef& normals, const SimplificationOptions& options) {
  require_rows(coordinates, vertices.rows(), "coordinates");
  require_finite(coordinates, "coordinates");
  require_finite(points, "points", kLargestToTheFourth);
  require_rows(normals, points.rows(), "normals");
  require_finite(normals, "normals");
  require(options.evenness >= 0 && options.border >= 0 && options.pull > 0,
          "evenness and border must be 0 or more, pull positive");
  const MeshCheck check = check_mesh(vertices, faces);
  require(check.manifold() && check.oriented(), "simplification needs a manifold, oriented mesh");
}

/// Of each face number: the point farthest beyond an error that it is the nearest face of, and -1 if there is none.
std::vector<Index> farthest_beyond(const EditableMesh& mesh, const PointsRef& points, double error) {
  const std::vector<Index> numbers = mesh.faces_in_order();
  const TriangleMesh arrays = mesh.mesh();
  const SurfacePoints feet = closest_surface_points(arrays.vertices, arrays.faces, points);
  std::vector<Index> farthest(static_cast<std::size_t>(mesh.face_numbers()), -1);
  for (Index p = 0; p < points.rows(); ++p) {
    Index& kept = farthest[numbers[feet.face(p)]];
    if (feet.distance(p) > (kept < 0 ? error * kRounding : feet.distance(kept))) kept = p;
  }
  return farthest;
}

bool any(const std::vector<Index>& points) {
  return std::any_of(points.begin(), points.end(), [](Index p) { return p >= 0; });
}

/// Whether a split of the edge ab at a point would fold a face over: half of it would turn by more than a right angle,
/// and be seen from behind by the normal of the point.
bool split_folds(const EditableMesh& mesh, Index a, Index b, const Eigen::Vector3d& point,
                 const Eigen::Vector3d& normal) {
  const auto vector_of = [&](Index f, Index replaced) {
    Eigen::Vector3d at[3];
    for (int i = 0; i < 3; ++i) {
      const Index corner = mesh.corners(f)[i];
      at[i] = corner == replaced ? point : mesh.position(corner);
    }
    return area_vector(at[0], at[1], at[2]);
  };
  const auto folds = [&](Index f) {
    const Eigen::Vector3d whole = vector_of(f, -1), halves[] = {vector_of(f, a), vector_of(f, b)};
    return std::any_of(std::begin(halves), std::end(halves),
                       [&](const Eigen::Vector3d& half) { return half.dot(whole) <= 0 && half.dot(normal) <= 0; });
  };
  const auto& around = mesh.faces_around(a);
  return std::any_of(around.begin(), around.end(), [&](Index f) { return mesh.has_corner(f, b) && folds(f); });
}

/// Splits each face that a point is too far from, at that point: the face, or its edge where the point lies near that;
/// but none that this would fold. The part of a new vertex has a place in R^d, and no extent. False if none was split.
bool split_beyond(EditableMesh& mesh, std::vector<SurfacePart>& parts, const std::vector<Index>& beyond,
                  const PointsRef& points, const PointsRef& normals) {
  bool split = false;
  for (Index f = 0; f < static_cast<Index>(beyond.size()); ++f) {
    if (beyond[f] < 0) continue;
    const Eigen::Vector3d point = points.row(beyond[f]);
    const EditableMesh::Corners corners = mesh.corners(f);
    const Eigen::Vector3d a = mesh.position(corners[0]), b = mesh.position(corners[1]), c = mesh.position(corners[2]);
    const Eigen::Vector3d normal = area_vector(a, b, c);
    Eigen::Vector3d weights(normal.dot(area_vector(point, b, c)), normal.dot(area_vector(a, point, c)),
                            normal.dot(area_vector(a, b, point)));
    weights /= normal.squaredNorm();
    if (!weights.allFinite()) continue;
    int least;
    const double beside = weights.minCoeff(&least);
    const Index from = corners[(least + 1) % 3], to = corners[(least + 2) % 3];
    if (beside < kNearEdge && !split_folds(mesh, from, to, point, normals.row(beyond[f]))) {
      mesh.split_edge(from, to, point);
    } else if (beside > 0) {
      mesh.split(f, point);
    } else {
      continue;
    }
    SurfacePart part;
    part.centroid = Eigen::VectorXd::Zero(parts[corners[0]].centroid.size());
    weights = weights.cwiseMax(0) / weights.cwiseMax(0).sum();
    for (int i = 0; i < 3; ++i) part.centroid += weights[i] * parts[corners[i]].centroid;
    parts.push_back(part);
    split = true;
  }
  return split;
}

}  // namespace

SimplifiedMesh simplify_mesh(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                             const PointsRef& points, const PointsRef& normals, const MeshBudget& budget,
                             const SimplificationOptions& options, const Progress& progress, const MaskRef& fixed) {
  if (fixed.size() > 0) require_rows(fixed, vertices.rows(), "fixed");
  require(budget.vertices >= 0 && budget.faces >= 0, "the budget must be 0 or more vertices and faces");
  check_contract(vertices, coordinates, faces, points, normals, options);
  EditableMesh mesh(vertices, faces);
  std::vector<SurfacePart> parts = parts_of(vertices, coordinates, faces, points, normals, options.border);
  EdgeCollapses collapses(mesh, parts, {options.evenness, options.pull}, nullptr, fixed);
  const Index first = excess(mesh, budget);
  Index next = first;
  for (Index left = first; left > 0; left = excess(mesh, budget)) {
    if (left <= next) {
      report(progress, 1 - static_cast<double>(left) / static_cast<double>(first));
      next = left - kCollapsesPerReport;
    }
    if (!collapses.collapse_next()) break;
  }
  report(progress, 1);
  return arrays_of(mesh, parts);
}

SimplifiedMesh simplify_within(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                               const PointsRef& points, const PointsRef& normals,
                               const Eigen::Ref<const Eigen::VectorXd>& radii, double error,
                               const SimplificationOptions& options, const Progress& progress) {
  require(error > 0 && points.rows() > 0 && faces.rows() > 0, "the error must be positive, and of points and faces");
  require_rows(radii, points.rows(), "radii");
  require_finite(radii, "radii");
  check_contract(vertices, coordinates, faces, points, normals, options);
  const DisksRef disks{points, normals, radii};
  SimplifiedMesh made{vertices, coordinates, faces};
  for (int round = 0;; ++round) {
    EditableMesh mesh(made.vertices, made.faces);
    std::vector<SurfacePart> parts =
        parts_of(made.vertices, made.coordinates, made.faces, points, normals, options.border);
    PointLinks links(mesh, disks, error);
    EdgeCollapses collapses(mesh, parts, {options.evenness, options.pull}, &links);
    const double first = static_cast<double>(mesh.vertices_left());
    for (Index done = 0; collapses.collapse_next(); ++done) {
      if (done % kCollapsesPerReport > 0) continue;
      report(progress, (round + static_cast<double>(done) / first) / kRounds);
    }
    std::vector<Index> beyond = farthest_beyond(mesh, points, error);
    if (!any(beyond) || round + 1 == kRounds) {
      report(progress, 1);
      return arrays_of(mesh, parts);
    }
    for (int splits = 0; any(beyond) && splits < kSplits; ++splits) {
      if (!split_beyond(mesh, parts, beyond, points, normals)) break;
      beyond = farthest_beyond(mesh, points, error);
    }
    made = arrays_of(mesh, parts);
  }
}

}  // namespace hdpea
