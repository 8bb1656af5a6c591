// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/crease_alignment.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/mesh/guarded_mesh.hpp"
#include "hdpea_cpp/points/creases_nearby.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::RowVector3d;

/// An edge that runs across a crease, by the half-edge of lower index.
struct Crossing {
  Index halfedge, sample;
};

/// Each lets flips and moves make room for more; most meshes need two.
constexpr int kRounds = 4;
/// A vertex moves less than this share of the edges at it; the nearest go first, as they drag the mesh the least.
constexpr double kNearest = 0.2, kNear = 0.35, kFarthest = 0.7;
/// Nor does it move farther than this, in spacings of the crease. Where edges are much longer than that, the planes of
/// the points have put vertices on creases already, and others would be torn off the surface.
constexpr double kFarthestOfSpacing = 1.5;
/// What is this near a crease, in its spacings, lies on it already.
constexpr double kOnCrease = 0.05;
/// An edge crosses a crease that passes by within shares of its length and of the crease's spacing, and not in front of
/// the sheets that meet there.
constexpr double kBeside = 0.5, kInFront = 0.25, kOfSpacing = 0.25;
/// Samples belong to one line whose directions agree to within this cosine, and that are about as far from a vertex.
constexpr double kSameLine = 0.7, kAsFar = 1.5, kAsFarOfSpacing = 0.1;
/// A face with all corners on a line is lower than this share of its longest edge, squared.
constexpr double kFlat = 0.15;

class Alignment {
 public:
  Alignment(const PointsRef& vertices, const FacesRef& faces, const Creases& creases, const MaskRef& fixed)
      : creases_(creases), lines_(creases), mesh_(vertices, faces), edges_(mesh_.topology()), fixed_(fixed) {
    held_.assign(static_cast<std::size_t>(vertices.rows()), false);
    lengths_ = mesh_.mean_lengths();
    near_ = lines_.near(mesh_.vertices());
  }

  TriangleMesh run() {
    take_corners();
    hold_those_on_creases();
    hold_those_beyond_both_sides();
    for (int round = 0; round < kRounds; ++round) {
      const Index before = changes_;
      const std::vector<Crossing> crossings = find_crossings();
      for (double most : {kNearest, kNear}) snap(crossings, most);
      flip(crossings);
      snap(crossings, kFarthest);
      flip_flat_faces();
      if (changes_ == before) break;
    }
    return {mesh_.vertices(), edges_.faces()};
  }

 private:
  Vector at(Index v) const { return mesh_.at(v); }

  void take_corners() {
    constexpr Index candidates = 4;
    if (creases_.corners.empty()) return;
    const Points corners = crease_corners(creases_);
    const Neighbors near = nearest_neighbors(mesh_.vertices(), corners, candidates), samples = lines_.near(corners);
    for (Index c = 0; c < corners.rows(); ++c) {
      for (Index v : near.row(c)) {
        if (v < 0 || held_[v]) continue;
        if ((at(v) - corners.row(c)).norm() > kFarthest * lengths_(v)) continue;
        if (move(v, corners.row(c), samples(c, 0))) break;
      }
    }
  }

  /// Vertices that lie on a crease already: of their edges none crosses it.
  void hold_those_on_creases() {
    for (Index v = 0; v < mesh_.vertices().rows(); ++v) {
      for (Index s : near_.row(v)) {
        if (held_[v] || s < 0) break;
        if (lines_.covers(s, at(v)) && lines_.distance(s, at(v)) <= kOnCrease * lines_.spacing(s))
          move(v, lines_.foot(s, at(v)), s);
      }
    }
  }

  /// Vertices in the air in front of a crease: of both its sides the crease is the nearest place.
  void hold_those_beyond_both_sides() {
    for (Index v = 0; v < mesh_.vertices().rows(); ++v) {
      const Index s = near_(v, 0);
      if (held_[v] || !lines_.covers(s, at(v)) || !lines_.is_beyond_both(s, at(v))) continue;
      move(v, lines_.foot(s, at(v)), s);
    }
  }

  /// Moves a vertex onto a crease near one of its samples, unless that is too far or harms a face.
  bool move(Index v, const Vector& to, Index sample) {
    if (fixed_.size() > 0 && fixed_(v)) return false;
    if ((to - at(v)).norm() > kFarthestOfSpacing * lines_.spacing(sample)) return false;
    if (!mesh_.move(v, to)) return false;
    ++changes_;
    held_[v] = true;
    return true;
  }

  std::vector<Crossing> find_crossings() const {
    std::vector<Index> edges;
    for (Index h = 0; h < edges_.halfedges(); ++h) {
      const bool once = edges_.opposite(h) < 0 || edges_.opposite(h) > h;
      if (once && !held_[edges_.source(h)] && !held_[edges_.target(h)]) {
        edges.push_back(h);
      }
    }
    Points middles(static_cast<Index>(edges.size()), 3);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      middles.row(static_cast<Index>(e)) = (at(edges_.source(edges[e])) + at(edges_.target(edges[e]))) / 2;
    }
    const Neighbors near = lines_.near(middles);
    std::vector<Crossing> crossings;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      Index best = -1;
      double least = 0;
      for (Index s : near.row(static_cast<Index>(e))) {
        if (s < 0) continue;
        const double along = crosses(edges[e], s);
        if (along < 0 || (best >= 0 && along >= least)) continue;
        best = s;
        least = along;
      }
      if (best >= 0) crossings.push_back({edges[e], best});
    }
    return crossings;
  }

  /// How far along the crease from the sample an edge crosses it; negative if it does not.
  double crosses(Index h, Index s) const {
    const Vector a = at(edges_.source(h)), b = at(edges_.target(h));
    const double side_a = lines_.side(s, a), side_b = lines_.side(s, b);
    if (side_a * side_b >= 0) return -1;
    const Vector x = a + (b - a) * (side_a / (side_a - side_b));
    const double length = (b - a).norm(), spacing = lines_.spacing(s);
    if (!lines_.covers(s, x) || lines_.distance(s, x) > kBeside * length + kOfSpacing * spacing) return -1;
    if (std::max(lines_.height(s, a), lines_.height(s, b)) > kInFront * length + kOfSpacing * spacing) return -1;
    return std::abs(lines_.along(s, x));
  }

  /// Moves the nearer ends of edges onto their crease, nearest first, as long as they are nearer than a share of the
  /// edges there.
  void snap(const std::vector<Crossing>& crossings, double most) {
    using Choice = std::tuple<double, Index, Index>;
    std::vector<Choice> choices;
    for (std::size_t c = 0; c < crossings.size(); ++c) {
      const Index h = crossings[c].halfedge;
      for (Index v : {edges_.source(h), edges_.target(h)}) {
        const double distance = lines_.distance(crossings[c].sample, at(v)) / lengths_(v);
        if (distance < most) choices.emplace_back(distance, v, static_cast<Index>(c));
      }
    }
    std::sort(choices.begin(), choices.end());
    for (const auto& [distance, v, c] : choices) {
      const Index h = crossings[c].halfedge;
      // An edge that was flipped is another one by now.
      if (v != edges_.source(h) && v != edges_.target(h)) continue;
      if (held_[edges_.source(h)] || held_[edges_.target(h)]) continue;
      move(v, nearest_on_crease(v, crossings[c].sample), crossings[c].sample);
    }
  }

  /// By the sample beside the vertex, if there is one on the same line.
  Vector nearest_on_crease(Index v, Index sample) const {
    Index best = sample;
    double least = std::abs(lines_.along(sample, at(v)));
    for (Index s : near_.row(v)) {
      if (s < 0 || std::abs(lines_.direction(s).dot(lines_.direction(sample))) < kSameLine) continue;
      const double along = std::abs(lines_.along(s, at(v)));
      const double as_far = kAsFar * lines_.distance(sample, at(v)) + kAsFarOfSpacing * lines_.spacing(s);
      if (along >= least || lines_.distance(s, at(v)) > as_far) continue;
      best = s;
      least = along;
    }
    return lines_.foot(best, at(v));
  }

  /// Flips edges across a crease whose opposite vertices both lie on it.
  void flip(const std::vector<Crossing>& crossings) {
    for (const Crossing& each : crossings) {
      const Index h = each.halfedge;
      if (edges_.opposite(h) < 0 || held_[edges_.source(h)] || held_[edges_.target(h)]) continue;
      if (!held_[edges_.apex(h)] || !held_[edges_.apex(edges_.opposite(h))]) continue;
      changes_ += mesh_.flip(h);
    }
  }

  /// Flips the longest edges of faces that lie with all corners on one line of a crease.
  void flip_flat_faces() {
    for (Index h = 0; h < edges_.halfedges(); ++h) {
      const Index a = edges_.source(h), b = edges_.target(h), c = edges_.apex(h);
      if (!held_[a] || !held_[b] || !held_[c] || edges_.opposite(h) < 0) continue;
      const double length = (at(b) - at(a)).norm();
      if (mesh_.area(h / 3).norm() > kFlat * length * length) continue;
      if (length < (at(c) - at(a)).norm() || length < (at(c) - at(b)).norm()) continue;
      changes_ += mesh_.flip(h);
    }
  }

  const Creases& creases_;
  CreasesNearby lines_;
  GuardedMesh mesh_;
  const FlippableMesh& edges_;  // its topology
  Mask fixed_;
  std::vector<char> held_;  // whether each vertex lies on a crease
  Eigen::VectorXd lengths_;
  Neighbors near_;  // samples of creases near each vertex as it was
  Index changes_ = 0;
};

}  // namespace

TriangleMesh align_to_creases(const PointsRef& vertices, const FacesRef& faces, const Creases& creases,
                              const MaskRef& fixed) {
  require_mesh(vertices, faces);
  if (fixed.size() > 0) require_rows(fixed, vertices.rows(), "fixed");
  if (creases.samples.empty() || faces.rows() == 0) return {vertices, faces};
  return Alignment(vertices, faces, creases, fixed).run();
}

}  // namespace hdpea
