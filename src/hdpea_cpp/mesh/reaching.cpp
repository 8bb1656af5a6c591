// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/reaching.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/triangle_distance.hpp"
#include "hdpea_cpp/mesh/editable_mesh.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::RowVector3d;
using Triangle = std::array<Vector, 3>;

/// Each place changes once in a round: a rim that is missing comes back vertex by vertex.
constexpr int kRounds = 4;
/// Share of the distance of a far point that the points around may be at most from the faces afterwards.
constexpr double kClearlyNearer = 0.8;
/// Least cosine between a point's normal and that of a face of its sheet.
constexpr double kSameSheet = 0.3;

Vector normal_of(const Triangle& face) { return area_vector(face[0], face[1], face[2]); }

/// What gives way to a point, of each face that has it: one corner, which moves there, an edge, or the face itself,
/// which are split there.
using Replaced = std::vector<Index>;

class Reaching {
 public:
  Reaching(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points, const PointsRef& normals)
      : points_(points),
        normals_(normals),
        mesh_(vertices, faces),
        distance_(points.rows()),
        face_(static_cast<std::size_t>(points.rows()), -1) {}

  /// Whether any point was reached.
  bool round(double far) {
    find_feet();
    std::vector<std::pair<double, Index>> farthest_first;
    for (Index p = 0; p < points_.rows(); ++p) {
      if (distance_(p) > far) farthest_first.emplace_back(-distance_(p), p);
    }
    std::sort(farthest_first.begin(), farthest_first.end());
    bool any = false;
    for (const auto& [_, p] : farthest_first) any = reach(p) || any;
    return any;
  }

  ReachedMesh result() const {
    TriangleMesh mesh = mesh_.mesh();
    return {std::move(mesh.vertices), std::move(mesh.faces),
            Eigen::Map<const Eigen::Vector<Index, Eigen::Dynamic>>(reached_.data(), std::ssize(reached_))};
  }

 private:
  /// Of the points closest to faces that have changed; at first of all.
  void find_feet() {
    std::vector<Index> numbers, lost;
    for (Index f = 0; f < mesh_.face_numbers(); ++f) {
      if (mesh_.has_face(f)) numbers.push_back(f);
    }
    for (Index p = 0; p < points_.rows(); ++p) {
      if (face_[p] < 0 || changed_.contains(face_[p])) lost.push_back(p);
    }
    const TriangleMesh mesh = mesh_.mesh();
    const SurfacePoints feet = closest_surface_points(mesh.vertices, mesh.faces, points_(lost, Eigen::all));
    for (Index row = 0; row < std::ssize(lost); ++row) {
      distance_(lost[row]) = feet.distance(row);
      face_[lost[row]] = numbers[feet.face(row)];
    }
    points_at_.assign(static_cast<std::size_t>(mesh_.face_numbers()), {});
    for (Index p = 0; p < points_.rows(); ++p) points_at_[face_[p]].push_back(p);
    changed_.clear();
  }

  bool reach(Index p) {
    const EditableMesh::Corners corners = mesh_.corners(face_[p]);
    std::set<Index> around;
    for (const Index v : corners) around.insert(mesh_.faces_around(v).begin(), mesh_.faces_around(v).end());
    const auto is_changed = [&](Index f) { return changed_.contains(f); };
    const auto is_of_its_sheet = [&](Index f) {
      const Vector normal = normal_of(triangle(f));
      return normals_.row(p).dot(normal) >= kSameSheet * normal.norm();
    };
    if (std::any_of(around.begin(), around.end(), is_changed)) return false;
    if (std::none_of(around.begin(), around.end(), is_of_its_sheet)) return false;

    const auto [a, b, c] = corners;
    Replaced best;
    double least = std::numeric_limits<double>::infinity();
    const double most = kClearlyNearer * kClearlyNearer * distance_(p) * distance_(p);
    for (const Replaced& replaced : {Replaced{a, b, c}, {a, b}, {b, c}, {c, a}, {a}, {b}, {c}}) {
      const double sum = squared_distances(around, faces_after(replaced, p, around), most);
      if (sum < least) least = sum, best = replaced;
    }
    if (best.empty()) return false;
    replace(best, p);
    changed_.insert(around.begin(), around.end());
    return true;
  }

  Triangle triangle(Index f) const {
    const auto [a, b, c] = mesh_.corners(f);
    return {mesh_.position(a).transpose(), mesh_.position(b).transpose(), mesh_.position(c).transpose()};
  }

  /// The faces around if something is replaced by a point; none if that turns one by more than a right angle.
  std::vector<Triangle> faces_after(const Replaced& replaced, Index p, const std::set<Index>& around) const {
    std::vector<Triangle> faces;
    for (const Index f : around) {
      const Triangle before = triangle(f);
      const auto is_corner = [&](Index v) { return mesh_.has_corner(f, v); };
      if (!std::all_of(replaced.begin(), replaced.end(), is_corner)) {
        faces.push_back(before);
        continue;
      }
      for (int i = 0; i < 3; ++i) {
        if (std::find(replaced.begin(), replaced.end(), mesh_.corners(f)[i]) == replaced.end()) continue;
        Triangle after = before;
        after[i] = points_.row(p);
        if (normal_of(before).dot(normal_of(after)) <= 0) return {};
        faces.push_back(after);
      }
    }
    return faces;
  }

  /// Of the points closest to the faces around from what these become, summed; infinite if one is more than `most`.
  double squared_distances(const std::set<Index>& around, const std::vector<Triangle>& faces, double most) const {
    double sum = 0;
    for (const Index f : around) {
      for (const Index q : points_at_[f]) {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : faces) {
          least = std::min(least, squared_distance_from_triangle(points_.row(q), a, b, c));
        }
        if (least > most) return std::numeric_limits<double>::infinity();
        sum += least;
      }
    }
    return sum;
  }

  void replace(const Replaced& replaced, Index p) {
    const Eigen::Vector3d to = points_.row(p).transpose();
    if (replaced.size() == 1) return mesh_.move(replaced[0], to);
    if (replaced.size() == 2) {
      mesh_.split_edge(replaced[0], replaced[1], to);
    } else {
      mesh_.split(face_[p], to);
    }
    reached_.push_back(p);
  }

  const PointsRef& points_;
  const PointsRef& normals_;
  EditableMesh mesh_;
  // As they were at the beginning of the round:
  Eigen::VectorXd distance_;                   // of each point from the mesh
  std::vector<Index> face_;                    // closest to each point
  std::vector<std::vector<Index>> points_at_;  // of each face: the points that it is closest to
  std::set<Index> changed_;                    // faces around what was replaced since
  std::vector<Index> reached_;
};

}  // namespace

ReachedMesh reach_points(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points,
                         const PointsRef& normals, double far) {
  require(far > 0, "the distance from which points are far must be positive");
  require_finite(points, "points", kLargestToTheFourth);
  require_rows(normals, points.rows(), "normals");
  require_finite(normals, "normals");
  const MeshCheck check = check_mesh(vertices, faces);
  require(check.manifold() && check.oriented() && faces.rows() >= 1, "reaching points needs a manifold, oriented mesh");
  Reaching reaching(vertices, faces, points, normals);
  for (int round = 0; round < kRounds && reaching.round(far); ++round) continue;
  return reaching.result();
}

}  // namespace hdpea
