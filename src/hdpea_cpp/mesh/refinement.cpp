// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/refinement.hpp"

#include <Eigen/Dense>
#include <numeric>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/angles.hpp"
#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "hdpea_cpp/mesh/vertex_system.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

/// Normals of the faces times twice their areas.
Points area_vectors(const Points& vertices, const FacesRef& faces) {
  Points vectors(faces.rows(), 3);
  for (Index f = 0; f < faces.rows(); ++f) {
    vectors.row(f) = area_vector(vertices.row(faces(f, 0)), vertices.row(faces(f, 1)), vertices.row(faces(f, 2)));
  }
  return vectors;
}

/// Tells whether a point belongs to the sheet that it was projected to.
class Agreement {
 public:
  Agreement(const Points& vertices, const FacesRef& faces, double min_cosine)
      : faces_(faces),
        areas_(area_vectors(vertices, faces)),
        faces_around_(static_cast<std::size_t>(vertices.rows())),
        min_cosine_(min_cosine) {
    for (Index f = 0; f < faces.rows(); ++f) {
      for (Index v : faces.row(f)) faces_around_[v].push_back(f);
    }
  }

  /// Asks every face that the foot lies on: those at an edge or a corner are equally close, and which of them
  /// was found is a matter of rounding.
  bool holds(const Eigen::RowVector3d& normal, Index face, const Eigen::RowVector3d& barycentric) const {
    constexpr double nothing = 1e-9;
    Index corner;
    barycentric.maxCoeff(&corner);
    for (Index f : faces_around_[faces_(face, corner)]) {
      bool has_foot = true;
      for (int i = 0; i < 3; ++i) {
        has_foot = has_foot && (barycentric(i) < nothing || (faces_.row(f).array() == faces_(face, i)).any());
      }
      if (has_foot && normal.dot(areas_.row(f)) >= min_cosine_ * areas_.row(f).norm()) return true;
    }
    return false;
  }

 private:
  const FacesRef& faces_;
  Points areas_;
  std::vector<std::vector<Index>> faces_around_;
  double min_cosine_;
};

/// The size of the faces around each vertex, sqrt(2 area).
Eigen::VectorXd sizes(const Points& vertices, const FacesRef& faces) {
  const Points areas = area_vectors(vertices, faces);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(vertices.rows()), counts = sums;
  for (Index f = 0; f < faces.rows(); ++f) {
    for (Index v : faces.row(f)) {
      sums(v) += areas.row(f).norm();
      counts(v) += 1;
    }
  }
  return (sums.array() / counts.array().max(1)).sqrt();
}

/// The vertices that fit best in one round beside those that are fixed: they solve the normal equations.
Points fitted_vertices(const Points& vertices, const FacesRef& faces, const PointsRef& points, const PointsRef& normals,
                       const RefinementOptions& options, const MaskRef& fixed) {
  const SurfacePoints feet = closest_surface_points(vertices, faces, points);
  const Agreement agreement(vertices, faces, options.min_cosine);
  const double pull = options.pull * static_cast<double>(points.rows()) / static_cast<double>(vertices.rows());
  const Eigen::VectorXd reach = options.max_distance * sizes(vertices, faces);
  VertexSystem system(vertices.rows(), faces);
  system.add_to_diagonal(pull);
  Points right = pull * vertices;
  for (Index p = 0; p < points.rows(); ++p) {
    const Index f = feet.face(p);
    const Eigen::RowVector3d weights = feet.barycentric.row(p), normal = normals.row(p);
    const double farthest = reach(faces.row(f).transpose()).maxCoeff();
    if (feet.distance(p) > farthest || !agreement.holds(normal, f, weights)) continue;
    system.add(f, weights, normal);
    const double offset = normal.dot(points.row(p));
    for (int i = 0; i < 3; ++i) right.row(faces(f, i)) += offset * weights(i) * normal;
  }
  return system.solve(right, vertices, fixed);
}

Eigen::VectorXd distances(const PointsRef& points, const NearestPoints& nearest, const Points& places) {
  const Eigen::Vector<Index, Eigen::Dynamic> found = nearest.to(places);
  Eigen::VectorXd distances(places.rows());
  for (Index i = 0; i < places.rows(); ++i) distances(i) = (points.row(found(i)) - places.row(i)).norm();
  return distances;
}

/// Of each face the sum of the normals of the points nearest to its corners.
Points normals_at_corners(const PointsRef& vertices, const FacesRef& faces, const NearestPoints& points,
                          const PointsRef& normals) {
  const Eigen::Vector<Index, Eigen::Dynamic> nearest = points.to(vertices);
  Points sums = Points::Zero(faces.rows(), 3);
  for (Index f = 0; f < faces.rows(); ++f) {
    for (const Index v : faces.row(f)) sums.row(f) += normals.row(nearest(v));
  }
  return sums;
}

/// Halves the step of the vertices that leave the cloud: where few points hold one, least squares may send it far out
/// along the planes of its faces. Farther than a gap between points, and than it was, is too far.
void stay_near(const PointsRef& points, const NearestPoints& nearest, const Points& from, const Eigen::VectorXd& gap,
               Points& to) {
  constexpr int halvings = 4;
  const Eigen::VectorXd most = distances(points, nearest, from).cwiseMax(gap);
  std::vector<Index> moved(static_cast<std::size_t>(to.rows()));
  std::iota(moved.begin(), moved.end(), Index{0});
  for (int round = 0; round < halvings && !moved.empty(); ++round) {
    const Eigen::VectorXd found = distances(points, nearest, to(moved, Eigen::all));
    std::vector<Index> too_far;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (found(i) > most(moved[i])) too_far.push_back(moved[i]);
    }
    for (const Index v : too_far) to.row(v) = (from.row(v) + to.row(v)) / 2;
    moved = std::move(too_far);
  }
}

/// Halves the step of the vertices of spoilt faces until there are none; after a few halvings they stay put.
///
/// @param outward  (f, 3) the sum of the points' normals at the corners: no face may turn against it
Points take_safe_step(const Points& outward, const Points& from, const Points& to, const FacesRef& faces,
                      const RefinementOptions& options) {
  constexpr int halvings = 5;
  const Points before = area_vectors(from, faces);
  const double least_cosine = cosine_of(options.max_turn);
  Eigen::VectorXd step = Eigen::VectorXd::Ones(from.rows());
  Points moved = to;
  for (int round = 0;; ++round) {
    const Points after = area_vectors(moved, faces);
    bool spoilt = false;
    for (Index f = 0; f < faces.rows(); ++f) {
      const double old_area = before.row(f).norm(), new_area = after.row(f).norm();
      const bool turned = before.row(f).dot(after.row(f)) < least_cosine * old_area * new_area;
      const bool turned_over = outward.row(f).dot(before.row(f)) >= 0 && outward.row(f).dot(after.row(f)) < 0;
      if (!turned && !turned_over && new_area >= options.min_area * old_area) continue;
      for (Index v : faces.row(f)) {
        spoilt = spoilt || step(v) > 0;
        step(v) = round < halvings ? step(v) / 2 : 0;
      }
    }
    if (!spoilt) return moved;
    moved = from + step.asDiagonal() * (to - from);
  }
}

}  // namespace

Points refine_vertices(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points,
                       const PointsRef& normals, const RefinementOptions& options, const Progress& progress,
                       const MaskRef& fixed) {
  require(faces.rows() >= 1 && points.rows() >= 1, "a fit needs at least one face and one point");
  require_mesh(vertices, faces);
  require_finite(vertices, "vertices", kLargestToTheFourth);
  require_finite(points, "points", kLargestToTheFourth);
  require_rows(normals, points.rows(), "normals");
  if (fixed.size() > 0) require_rows(fixed, vertices.rows(), "fixed");
  require_finite(normals, "normals");
  require(options.rounds >= 0 && options.pull > 0 && options.max_distance > 0 && options.max_gap > 0,
          "rounds must be 0 or more, pull, max_distance and max_gap positive");
  Points refined = vertices;
  const NearestPoints nearest(points);
  const Points outward = normals_at_corners(vertices, faces, nearest, normals);
  const Eigen::VectorXd gap = options.max_gap * sizes(refined, faces);
  for (Index round = 0; round < options.rounds; ++round) {
    report(progress, static_cast<double>(round) / static_cast<double>(options.rounds));
    Points fitted = fitted_vertices(refined, faces, points, normals, options, fixed);
    stay_near(points, nearest, refined, gap, fitted);
    refined = take_safe_step(outward, refined, fitted, faces, options);
  }
  report(progress, 1);
  return refined;
}

}  // namespace hdpea
