// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/incremental_manifold.hpp"

#include <algorithm>

namespace hdpea {
namespace {

constexpr std::array<std::array<int, 2>, 3> kEdges{{{0, 1}, {1, 2}, {0, 2}}};

std::uint64_t edge_key(Index a, Index b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
}

/// Whether the ascending triangle runs through its edge from the smaller index to the larger: all but (0, 2) do.
bool ascends(const Triangle& triangle, Index a, Index b) {
  return !(std::min(a, b) == triangle[0] && std::max(a, b) == triangle[2]);
}

/// The two corners of a triangle other than `vertex`.
std::pair<Index, Index> others(const Triangle& triangle, Index vertex) {
  if (triangle[0] == vertex) return {triangle[1], triangle[2]};
  if (triangle[1] == vertex) return {triangle[0], triangle[2]};
  return {triangle[0], triangle[1]};
}

}  // namespace

std::array<Index, 2> IncrementalManifold::faces_at(Index a, Index b) const {
  const auto found = edges_.find(edge_key(a, b));
  return found == edges_.end() ? std::array<Index, 2>{-1, -1} : found->second;
}

bool IncrementalManifold::opposite_parity(const Triangle& first, const Triangle& second, Index a, Index b) {
  return ascends(first, a, b) == ascends(second, a, b);
}

bool IncrementalManifold::link_stays_simple(Index vertex, Index b, Index c) const {
  const auto& faces = faces_of_[vertex];
  // Walk the link from b: through the face that has b, on to its other corner, until the path ends.
  std::size_t walked = 0;
  Index previous = -1, current = b;
  while (true) {
    Index through = -1;
    for (Index face : faces_at(vertex, current)) {
      if (face >= 0 && face != previous) through = face;
    }
    if (through < 0 || (walked > 0 && current == b)) break;
    const auto [p, q] = others(triangles_[through], vertex);
    current = p == current ? q : p;
    previous = through;
    ++walked;
  }
  const bool closes = walked > 0 && current == c;
  return !closes || walked == faces.size();
}

std::vector<std::pair<Index, bool>> IncrementalManifold::pieces_beside(const Triangle& triangle) {
  std::vector<std::pair<Index, bool>> pieces;
  for (const auto& [i, j] : kEdges) {
    const Index a = triangle[i], b = triangle[j];
    const Index neighbor = faces_at(a, b)[0];
    if (neighbor < 0) continue;
    const auto [piece, flipped] = piece_of(neighbor);
    const std::pair asked(piece, flipped != opposite_parity(triangles_[neighbor], triangle, a, b));
    if (std::find(pieces.begin(), pieces.end(), asked) == pieces.end()) pieces.push_back(asked);
  }
  return pieces;
}

bool IncrementalManifold::stays_orientable(const Triangle& triangle) {
  // Two neighbours of one piece must ask the same parity of the new triangle.
  const auto asked = pieces_beside(triangle);
  for (std::size_t k = 1; k < asked.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      if (asked[k].first == asked[other].first) return false;
    }
  }
  return true;
}

IncrementalManifold::Verdict IncrementalManifold::check(const Triangle& triangle) {
  for (const auto& [i, j] : kEdges) {
    if (faces_at(triangle[i], triangle[j])[1] >= 0) return Verdict::crowded_edge;
  }
  for (Index vertex : triangle) {
    // A closed fan takes no more; a new face must not close a part of an open one.
    const auto& faces = faces_of_[vertex];
    const bool closed = !faces.empty() && std::all_of(faces.begin(), faces.end(), [&](Index face) {
      const auto [p, q] = others(triangles_[face], vertex);
      return faces_at(vertex, p)[1] >= 0 && faces_at(vertex, q)[1] >= 0;
    });
    const auto [b, c] = others(triangle, vertex);
    if (closed || !link_stays_simple(vertex, b, c)) return Verdict::broken_link;
  }
  return stays_orientable(triangle) ? Verdict::fits : Verdict::not_orientable;
}

void IncrementalManifold::insert(const Triangle& triangle) {
  const Index face = static_cast<Index>(triangles_.size());
  pieces_.add();
  for (const auto& [i, j] : kEdges) {
    const Index a = triangle[i], b = triangle[j];
    auto& faces = edges_.try_emplace(edge_key(a, b), std::array<Index, 2>{-1, -1}).first->second;
    faces[faces[0] < 0 ? 0 : 1] = face;
    if (faces[1] < 0) continue;
    pieces_.join(faces[0], face, opposite_parity(triangles_[faces[0]], triangle, a, b));
  }
  triangles_.push_back(triangle);
  for (Index vertex : triangle) faces_of_[vertex].push_back(face);
}

}  // namespace hdpea
