// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/point_links.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

#include "hdpea_cpp/mesh/measured_triangle.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"

namespace hdpea {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of so many nearest points, one must have its disk within the error. Beside a crease most lie on the other side.
constexpr std::size_t kNearest = 24;

/// How far places are apart on faces, in disks or errors, and on edges, where a mesh cuts corners.
constexpr double kStep = 0.4, kStepOfEdges = 0.2;

/// Of a face, or of its edge, that are tried at most, however near the points are to one another.
constexpr double kMostPlaces = 2'000;

/// A correction is worth it for at most this share of the points, and if the corner moves by no more than so many times
/// what the worst point is off.
constexpr double kFewPoints = 0.1, kLongestLever = 10;
/// A corrected point comes so much nearer than it must.
constexpr double kRoom = 0.9;

std::vector<MeasuredTriangle> triangles_of(const std::vector<NewFace>& faces) {
  std::vector<MeasuredTriangle> triangles;
  for (const NewFace& face : faces) triangles.emplace_back(face.corners[0], face.corners[1], face.corners[2]);
  return triangles;
}

NewFace as_new(const EditableMesh& mesh, Index f) {
  const auto& [a, b, c] = mesh.corners(f);
  return {f, {mesh.position(a), mesh.position(b), mesh.position(c)}};
}

/// nanoflann's view of the points.
struct Adaptor {
  const PointsRef& points;

  std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(points.rows()); }
  double kdtree_get_pt(std::size_t row, std::size_t column) const { return points(row, column); }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace

struct PointLinks::Nearest {
  explicit Nearest(const PointsRef& points) : adaptor{points}, tree(3, adaptor) {}

  std::size_t search(const Eigen::Vector3d& at, std::size_t count) {
    return tree.knnSearch(at.data(), count, rows, squared);
  }

  Adaptor adaptor;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Adaptor>, Adaptor, 3, Index> tree;
  Index rows[kNearest];
  double squared[kNearest];
};

PointLinks::PointLinks(const EditableMesh& mesh, const DisksRef& disks, double error)
    : disks_(disks),
      error_(error),
      nearest_(std::make_unique<Nearest>(disks_.points)),
      points_of_(static_cast<std::size_t>(mesh.face_numbers())),
      worst_(static_cast<std::size_t>(mesh.face_numbers()), 0) {
  // The median disk holds a dozen points.
  Eigen::VectorXd radii = disks.radii;
  std::nth_element(radii.begin(), radii.begin() + radii.size() / 2, radii.end());
  scale_ = std::max(radii[radii.size() / 2], error_);
  const std::vector<Index> numbers = mesh.faces_in_order();
  const TriangleMesh arrays = mesh.mesh();
  const SurfacePoints feet = closest_surface_points(arrays.vertices, arrays.faces, disks_.points);
  distance_.assign(feet.distance.begin(), feet.distance.end());
  for (Index p = 0; p < disks_.points.rows(); ++p) points_of_[numbers[feet.face(p)]].push_back(p);
  for (Index f : numbers) {
    const double worst = worst_place(as_new(mesh, f), kInfinity);
    worst_[f] = worst > error_ ? worst : 0;
  }
}

PointLinks::~PointLinks() = default;

double PointLinks::limit(Index p) const { return std::max(error_, distance_[p]) * kRounding; }

double PointLinks::place_distance(const Eigen::Vector3d& at, const Eigen::Vector3d& facing, double enough) const {
  double least = kInfinity;
  for (const std::size_t count : {std::size_t{1}, kNearest}) {
    const std::size_t found = nearest_->search(at, count);
    for (std::size_t i = 0; i < found && least > enough; ++i) {
      const Index p = nearest_->rows[i];
      const double height = disks_.normals.row(p).dot(at.transpose() - disks_.points.row(p));
      const double aside = std::sqrt(std::max(0.0, nearest_->squared[i] - height * height)) - disks_.radii[p];
      const bool away = disks_.normals.row(p).dot(facing) < 0;
      least = std::min(least, std::hypot(height, std::max(aside, 0.0)) + (away ? error_ : 0));
    }
    if (least <= enough) return least;
  }
  return least;
}

double PointLinks::worst_place(const NewFace& face, double enough) const {
  const auto& [a, b, c] = face.corners;
  const Eigen::Vector3d ab = b - a, ac = c - a, facing = ab.cross(ac);
  double worst = 0;
  const auto look_at = [&](const Eigen::Vector3d& at) {
    worst = std::max(worst, place_distance(at, facing, std::max(error_, worst)));
    return worst <= enough;
  };
  for (int i = 0; i < 3; ++i) {
    if (face.moved >= 0 && i == (face.moved + 1) % 3) continue;  // the edge that stays
    const Eigen::Vector3d from = face.corners[i], along = face.corners[(i + 1) % 3] - from;
    const int pieces = static_cast<int>(std::min(kMostPlaces, std::ceil(along.norm() / (kStepOfEdges * scale_))));
    for (int k = 0; k < pieces; ++k) {
      if (!look_at(from + along * k / pieces)) return worst;
    }
  }
  // An even sequence of places (Roberts 2018), folded from a square into the triangle.
  constexpr double plastic = 1.32471795724474602596;
  const double step = kStep * scale_;
  const Index count = static_cast<Index>(std::min(kMostPlaces, facing.norm() / 2 / (step * step))) + 1;
  for (Index k = 1; k <= count; ++k) {
    double u = 0.5 + static_cast<double>(k) / plastic, v = 0.5 + static_cast<double>(k) / (plastic * plastic);
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    if (!look_at(a + u * ab + v * ac)) return worst;
  }
  return worst;
}

bool PointLinks::allows(const std::vector<Index>& old, const std::vector<NewFace>& faces) const {
  std::vector<MeasuredTriangle> triangles = triangles_of(faces);
  double allowed = error_;
  for (Index f : old) {
    allowed = std::max(allowed, worst_[f]);
    for (Index p : points_of_[f]) {
      const double squared = limit(p) * limit(p);
      const Eigen::Vector3d point = disks_.points.row(p);
      const auto near = std::find_if(triangles.begin(), triangles.end(), [&](const MeasuredTriangle& triangle) {
        return triangle.squared_distance(point, squared) < squared;
      });
      if (near == triangles.end()) return false;
      // The next point is likely to lie on the same one.
      std::swap(*near, triangles.front());
    }
  }
  return std::all_of(faces.begin(), faces.end(),
                     [&](const NewFace& face) { return worst_place(face, allowed) <= allowed; });
}

std::optional<Eigen::Vector3d> PointLinks::correction(const std::vector<Index>& old,
                                                      const std::vector<NewFace>& faces) const {
  const std::vector<MeasuredTriangle> triangles = triangles_of(faces);
  std::size_t points = 0, beyond = 0;
  for (Index f : old) points += points_of_[f].size();
  double worst = 0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  std::size_t last = 0;
  for (Index f : old) {
    for (Index p : points_of_[f]) {
      const Eigen::Vector3d point = disks_.points.row(p);
      const double within = limit(p) * limit(p);
      // The next point is likely to lie on the same one.
      double least = triangles[last].squared_distance(point, within);
      if (least <= within) continue;
      std::size_t nearest = last;
      for (std::size_t i = 0; i < triangles.size() && least > within; ++i) {
        const double squared = triangles[i].squared_distance(point, least);
        if (squared >= least) continue;
        least = squared;
        nearest = i;
      }
      last = nearest;
      if (least <= within) continue;
      if (static_cast<double>(++beyond) > kFewPoints * static_cast<double>(points)) return std::nullopt;
      const double distance = std::sqrt(least), excess = distance - limit(p);
      if (excess <= worst) continue;
      worst = excess;
      const Eigen::Vector3d weights = triangles[nearest].weights(point);
      const double weight = weights[faces[nearest].moved];
      if (weight * kLongestLever < 1) return std::nullopt;
      const auto& corners = faces[nearest].corners;
      const Eigen::Vector3d foot = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
      shift = (1 - kRoom * limit(p) / distance) / weight * (point - foot);
    }
  }
  return beyond > 0 ? std::optional(shift) : std::nullopt;
}

void PointLinks::replace(const std::vector<Index>& old, const std::vector<NewFace>& faces) {
  const std::vector<MeasuredTriangle> triangles = triangles_of(faces);
  std::vector<Index> moved;
  bool worse = false;
  for (Index f : old) {
    moved.insert(moved.end(), points_of_[f].begin(), points_of_[f].end());
    points_of_[f].clear();
    worse = worse || worst_[f] > 0;
    worst_[f] = 0;
  }
  for (const NewFace& face : faces) {
    points_of_.resize(std::max(points_of_.size(), static_cast<std::size_t>(face.number) + 1));
    worst_.resize(points_of_.size(), 0);
    const double worst = worse ? worst_place(face, kInfinity) : 0;
    worst_[face.number] = worst > error_ ? worst : 0;
  }
  for (Index p : moved) {
    const Eigen::Vector3d point = disks_.points.row(p);
    double least = kInfinity;
    Index nearest = faces.front().number;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const double squared = triangles[i].squared_distance(point, least);
      if (squared >= least) continue;
      least = squared;
      nearest = faces[i].number;
    }
    distance_[p] = std::sqrt(least);
    points_of_[nearest].push_back(p);
  }
}

}  // namespace hdpea
