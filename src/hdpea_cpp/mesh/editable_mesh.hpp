// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A triangle mesh that is edited in place: edges are collapsed and faces split, and it stays manifold and oriented.
///
/// Vertices and faces keep their numbers while they live; new ones get new numbers.
class EditableMesh {
 public:
  using Corners = std::array<Index, 3>;

  /// @param vertices  (v, 3)
  /// @param faces     (f, 3) edge- and vertex-manifold, oriented
  EditableMesh(const PointsRef& vertices, const FacesRef& faces);

  Index vertices_left() const { return vertices_left_; }
  Index faces_left() const { return faces_left_; }
  /// All numbers ever given are below these.
  Index vertex_numbers() const { return static_cast<Index>(positions_.size()); }
  Index face_numbers() const { return static_cast<Index>(corners_.size()); }

  bool has_vertex(Index v) const { return !faces_around_[v].empty(); }
  bool has_face(Index f) const { return corners_[f][0] >= 0; }
  const Eigen::Vector3d& position(Index v) const { return positions_[v]; }
  const Corners& corners(Index f) const { return corners_[f]; }
  const std::vector<Index>& faces_around(Index v) const { return faces_around_[v]; }
  bool has_corner(Index f, Index v) const;
  /// Ascending.
  std::vector<Index> neighbors(Index v) const;
  bool on_border(Index v) const { return neighbors(v).size() != faces_around_[v].size(); }

  /// Whether the surface stays a manifold of the same topology when the edge ab is collapsed (the link condition).
  bool may_collapse(Index a, Index b) const;

  void move(Index v, const Eigen::Vector3d& to) { positions_[v] = to; }

  /// Collapses the edge ab into a, which moves there.
  void collapse(Index a, Index b, const Eigen::Vector3d& to);

  /// Splits a face into three at a new vertex, and returns that. The face keeps its first two corners.
  Index split(Index f, const Eigen::Vector3d& at);

  /// Splits the edge ab, and the faces at it, at a new vertex, and returns that.
  Index split_edge(Index a, Index b, const Eigen::Vector3d& at);

  /// The numbers of the vertices that are left, ascending: the rows of `mesh`.
  std::vector<Index> left() const;
  /// The same of the faces.
  std::vector<Index> faces_in_order() const;
  TriangleMesh mesh() const;

 private:
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Corners> corners_;  ///< -1 where the face is gone
  std::vector<std::vector<Index>> faces_around_;
  Index vertices_left_, faces_left_;
};

}  // namespace hdpea
