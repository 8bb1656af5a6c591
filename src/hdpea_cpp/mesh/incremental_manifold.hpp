// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/signed_sets.hpp"
#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

using Triangle = std::array<Index, 3>;

/// A growing set of triangles that never stops being an orientable manifold.
///
/// Every edge has at most two faces, every vertex link is a set of paths or one cycle, and every
/// edge-connected piece can be oriented. Orientation is kept as a parity in a union-find forest (the merging
/// of two pieces flips one of them at no cost), so it does not depend on any normals.
class IncrementalManifold {
 public:
  explicit IncrementalManifold(Index vertex_count) : faces_of_(static_cast<std::size_t>(vertex_count)) {}

  enum class Verdict { fits, crowded_edge, broken_link, not_orientable };

  /// Whether the triangle, its indices ascending, can be added.
  Verdict check(const Triangle& triangle);
  /// Adds a triangle that check() said fits.
  void insert(const Triangle& triangle);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Index>& faces_of(Index vertex) const { return faces_of_[vertex]; }
  /// The faces at an edge: none, one or two; -1 where there is none.
  std::array<Index, 2> faces_at(Index a, Index b) const;
  /// The representative of a face's edge-connected piece, and whether the face is flipped against it.
  std::pair<Index, bool> piece_of(Index face) { return pieces_.find(face); }
  /// The pieces that share an edge with a triangle that is not inserted, each once for all its edges, by their
  /// representatives; and whether the ascending triangle would be flipped against the representative.
  std::vector<std::pair<Index, bool>> pieces_beside(const Triangle& triangle);
  /// How many faces the piece of a face has.
  Index piece_size(Index face) { return pieces_.size(face); }
  /// Whether two triangles that share the edge (a, b) must have opposite parities to agree in orientation.
  static bool opposite_parity(const Triangle& first, const Triangle& second, Index a, Index b);

 private:
  bool link_stays_simple(Index vertex, Index b, Index c) const;
  bool stays_orientable(const Triangle& triangle);

  std::vector<Triangle> triangles_;
  std::vector<std::vector<Index>> faces_of_;
  std::unordered_map<std::uint64_t, std::array<Index, 2>> edges_;  // looked up, never iterated
  SignedSets pieces_;                                              // of faces
};

}  // namespace hdpea
