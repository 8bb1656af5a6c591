// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/editable_mesh.hpp"

#include <algorithm>
#include <iterator>

namespace hdpea {

EditableMesh::EditableMesh(const PointsRef& vertices, const FacesRef& faces)
    : faces_around_(static_cast<std::size_t>(vertices.rows())), vertices_left_(0), faces_left_(faces.rows()) {
  for (Index v = 0; v < vertices.rows(); ++v) positions_.emplace_back(vertices.row(v));
  for (Index f = 0; f < faces.rows(); ++f) {
    corners_.push_back({faces(f, 0), faces(f, 1), faces(f, 2)});
    for (Index v : corners_.back()) faces_around_[v].push_back(f);
  }
  for (Index v = 0; v < vertices.rows(); ++v) vertices_left_ += has_vertex(v) ? 1 : 0;
}

bool EditableMesh::has_corner(Index f, Index v) const {
  return std::find(corners_[f].begin(), corners_[f].end(), v) != corners_[f].end();
}

std::vector<Index> EditableMesh::neighbors(Index v) const {
  std::vector<Index> found;
  for (Index f : faces_around_[v]) {
    for (Index corner : corners_[f]) {
      if (corner != v) found.push_back(corner);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool EditableMesh::may_collapse(Index a, Index b) const {
  const std::vector<Index> around_a = neighbors(a), around_b = neighbors(b);
  std::vector<Index> common;
  std::set_intersection(around_a.begin(), around_a.end(), around_b.begin(), around_b.end(), std::back_inserter(common));
  std::size_t shared = 0;
  // A face of a, and one of b, across both common neighbours would lie on one another afterwards.
  bool across_a = false, across_b = false;
  const auto across = [&](Index f) {
    return common.size() == 2 && has_corner(f, common[0]) && has_corner(f, common[1]);
  };
  for (Index f : faces_around_[a]) {
    if (has_corner(f, b)) {
      ++shared;
    } else {
      across_a = across_a || across(f);
    }
  }
  for (Index f : faces_around_[b]) across_b = across_b || (!has_corner(f, a) && across(f));
  if (shared == 0 || common.size() != shared || (across_a && across_b)) return false;
  if (faces_around_[a].size() + faces_around_[b].size() <= 2 * shared) return false;
  const bool border_a = around_a.size() != faces_around_[a].size(),
             border_b = around_b.size() != faces_around_[b].size();
  return !(border_a && border_b && shared == 2);
}

void EditableMesh::collapse(Index a, Index b, const Eigen::Vector3d& to) {
  for (Index f : faces_around_[b]) {
    if (!has_corner(f, a)) {
      std::replace(corners_[f].begin(), corners_[f].end(), b, a);
      faces_around_[a].push_back(f);
      continue;
    }
    for (Index v : corners_[f]) {
      if (v != b) std::erase(faces_around_[v], f);
    }
    corners_[f] = {-1, -1, -1};
    --faces_left_;
  }
  faces_around_[b].clear();
  --vertices_left_;
  positions_[a] = to;
}

Index EditableMesh::split(Index f, const Eigen::Vector3d& at) {
  const Index v = vertex_numbers(), second = face_numbers(), third = second + 1;
  const auto [a, b, c] = corners_[f];
  positions_.push_back(at);
  corners_[f] = {a, b, v};
  corners_.push_back({b, c, v});
  corners_.push_back({c, a, v});
  std::erase(faces_around_[c], f);
  faces_around_[b].push_back(second);
  faces_around_[c].insert(faces_around_[c].end(), {second, third});
  faces_around_[a].push_back(third);
  faces_around_.push_back({f, second, third});
  ++vertices_left_;
  faces_left_ += 2;
  return v;
}

Index EditableMesh::split_edge(Index a, Index b, const Eigen::Vector3d& at) {
  const Index v = vertex_numbers();
  positions_.push_back(at);
  faces_around_.emplace_back();
  ++vertices_left_;
  const std::vector<Index> around = faces_around_[a];
  for (Index f : around) {
    if (!has_corner(f, b)) continue;
    const Index other = face_numbers();
    corners_.push_back(corners_[f]);
    std::replace(corners_[f].begin(), corners_[f].end(), b, v);
    std::replace(corners_[other].begin(), corners_[other].end(), a, v);
    std::erase(faces_around_[b], f);
    for (Index corner : corners_[other]) faces_around_[corner].push_back(other);
    faces_around_[v].push_back(f);
    ++faces_left_;
  }
  return v;
}

std::vector<Index> EditableMesh::left() const {
  std::vector<Index> numbers;
  for (Index v = 0; v < vertex_numbers(); ++v) {
    if (has_vertex(v)) numbers.push_back(v);
  }
  return numbers;
}

std::vector<Index> EditableMesh::faces_in_order() const {
  std::vector<Index> numbers;
  for (Index f = 0; f < face_numbers(); ++f) {
    if (has_face(f)) numbers.push_back(f);
  }
  return numbers;
}

TriangleMesh EditableMesh::mesh() const {
  const std::vector<Index> numbers = left();
  std::vector<Index> row_of(positions_.size(), -1);
  TriangleMesh result{Points(static_cast<Index>(numbers.size()), 3), Faces(faces_left_, 3)};
  for (Index row = 0; row < result.vertices.rows(); ++row) {
    row_of[numbers[row]] = row;
    result.vertices.row(row) = positions_[numbers[row]].transpose();
  }
  Index row = 0;
  for (const Corners& corners : corners_) {
    if (corners[0] < 0) continue;
    for (int i = 0; i < 3; ++i) result.faces(row, i) = row_of[corners[i]];
    ++row;
  }
  return result;
}

}  // namespace hdpea
