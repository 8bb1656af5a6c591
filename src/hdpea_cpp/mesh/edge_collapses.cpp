// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/edge_collapses.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "hdpea_cpp/base/area_vector.hpp"

namespace hdpea {
namespace {

/// How often a vertex is shifted where its place would leave points beyond the error.
constexpr int kCorrections = 4;

}  // namespace

EdgeCollapses::EdgeCollapses(EditableMesh& mesh, std::vector<SurfacePart>& parts, const CollapseCost& cost,
                             PointLinks* links, const MaskRef& fixed)
    : mesh_(mesh),
      parts_(parts),
      cost_(cost),
      links_(links),
      fixed_(fixed),
      version_(parts.size(), 0),
      refused_(parts.size()) {
  for (Index a = 0; a < mesh.vertex_numbers(); ++a) {
    if (!mesh.has_vertex(a)) continue;
    for (Index b : mesh.neighbors(a)) {
      if (a < b) offer(a, b);
    }
  }
}

Eigen::Vector3d EdgeCollapses::place_of(Index a, Index b) const {
  const Eigen::Vector3d middle = (mesh_.position(a) + mesh_.position(b)) / 2;
  return nearest_to_planes(joined(parts_[a], parts_[b]), middle, cost_.pull);
}

void EdgeCollapses::offer(Index a, Index b) {
  if (fixed_.size() > 0 && (fixed_(a) || fixed_(b))) return;
  if (a > b) std::swap(a, b);
  const double away = joined(parts_[a], parts_[b]).squared_distance(place_of(a, b));
  const double cost = away + cost_.evenness * variance_growth(parts_[a], parts_[b]);
  candidates_.push({cost, a, b, version_[a], version_[b]});
}

bool EdgeCollapses::collapse_next() {
  while (!candidates_.empty()) {
    const Candidate next = candidates_.top();
    candidates_.pop();
    if (version_[next.a] != next.version_a || version_[next.b] != next.version_b) continue;
    if (try_collapse(next.a, next.b)) return true;
    refused_[next.a].push_back(next.b);
    refused_[next.b].push_back(next.a);
  }
  return false;
}

std::vector<NewFace> EdgeCollapses::faces_after(Index a, Index b, const Eigen::Vector3d& to,
                                                const std::vector<Index>& old) const {
  std::vector<NewFace> faces;
  for (Index f : old) {
    if (mesh_.has_corner(f, a) && mesh_.has_corner(f, b)) continue;
    NewFace face{f, {}};
    for (int i = 0; i < 3; ++i) {
      const Index corner = mesh_.corners(f)[i];
      face.corners[i] = corner == a || corner == b ? to : mesh_.position(corner);
      if (corner == a || corner == b) face.moved = i;
    }
    faces.push_back(face);
  }
  return faces;
}

bool EdgeCollapses::try_collapse(Index a, Index b) {
  if (!mesh_.may_collapse(a, b)) return false;
  std::vector<Index> old = mesh_.faces_around(a);
  for (Index f : mesh_.faces_around(b)) {
    if (!mesh_.has_corner(f, a)) old.push_back(f);
  }
  Eigen::Vector3d to = place_of(a, b);
  for (int correction = 0;; ++correction) {
    const std::vector<NewFace> faces = faces_after(a, b, to, old);
    if (!keeps_sides(faces)) return false;
    if (links_ == nullptr) break;
    if (links_->allows(old, faces)) {
      links_->replace(old, faces);
      break;
    }
    const std::optional<Eigen::Vector3d> shift =
        correction < kCorrections ? links_->correction(old, faces) : std::nullopt;
    if (!shift) return false;
    to += *shift;
  }
  collapse(a, b, to);
  return true;
}

void EdgeCollapses::collapse(Index a, Index b, const Eigen::Vector3d& to) {
  parts_[a] = joined(parts_[a], parts_[b]);
  mesh_.collapse(a, b, to);
  ++version_[a];
  ++version_[b];
  refused_[a].clear();
  refused_[b].clear();
  for (Index v : mesh_.neighbors(a)) {
    offer(a, v);
    for (Index other : std::exchange(refused_[v], {})) {
      if (other == a || other == b || !mesh_.has_vertex(other)) continue;
      std::erase(refused_[other], v);
      offer(v, other);
    }
  }
}

/// No face turns by more than a right angle.
bool EdgeCollapses::keeps_sides(const std::vector<NewFace>& faces) const {
  return std::all_of(faces.begin(), faces.end(), [&](const NewFace& face) {
    const auto& [a, b, c] = mesh_.corners(face.number);
    const Eigen::Vector3d before = area_vector(mesh_.position(a), mesh_.position(b), mesh_.position(c));
    return before.dot(area_vector(face.corners[0], face.corners[1], face.corners[2])) > 0;
  });
}

}  // namespace hdpea
