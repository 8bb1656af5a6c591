// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A manifold triangle mesh whose edges can be flipped.
///
/// Half-edge 3 f + i runs from corner i of face f to the next; a flip keeps the indices of both faces.
class FlippableMesh {
 public:
  /// @param faces  (f, 3) edge- and vertex-manifold, oriented
  FlippableMesh(const FacesRef& faces, Index vertex_count);

  const Faces& faces() const { return faces_; }
  Index halfedges() const { return faces_.size(); }
  Index corner(Index h) const { return faces_(h / 3, h % 3); }
  Index source(Index h) const { return corner(h); }
  Index target(Index h) const { return corner(next(h)); }
  /// The corner of the half-edge's face that it does not touch.
  Index apex(Index h) const { return corner(next(next(h))); }
  /// The half-edge of the neighbouring face; -1 at a border.
  Index opposite(Index h) const { return opposite_[h]; }
  /// In no particular order, but always the same.
  std::vector<Index> faces_around(Index v) const;
  /// Joins the apices on both sides of an edge instead of its ends; false, and nothing done, at a border or if the
  /// apices are joined already.
  bool flip(Index h);

 private:
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return next(next(h)); }
  void join(Index h, Index o);

  Faces faces_;
  std::vector<Index> opposite_;
  std::vector<Index> outgoing_;  // a half-edge from each vertex, -1 without one
};

}  // namespace hdpea
