// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/flippable_mesh.hpp"

#include <algorithm>
#include <tuple>

namespace hdpea {

FlippableMesh::FlippableMesh(const FacesRef& faces, Index vertex_count)
    : faces_(faces),
      opposite_(static_cast<std::size_t>(faces.size()), -1),
      outgoing_(static_cast<std::size_t>(vertex_count), -1) {
  std::vector<std::tuple<Index, Index, Index>> edges;
  edges.reserve(opposite_.size());
  for (Index h = 0; h < halfedges(); ++h) {
    const auto [low, high] = std::minmax({source(h), target(h)});
    edges.emplace_back(low, high, h);
    outgoing_[source(h)] = h;
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 1; e < edges.size(); ++e) {
    const auto& [low, high, h] = edges[e];
    const auto& [other_low, other_high, o] = edges[e - 1];
    if (low == other_low && high == other_high) join(h, o);
  }
}

std::vector<Index> FlippableMesh::faces_around(Index v) const {
  std::vector<Index> found;
  const Index start = outgoing_[v];
  if (start < 0) return found;
  Index h = start;
  do {
    found.push_back(h / 3);
    h = opposite_[previous(h)];
  } while (h >= 0 && h != start);
  if (h >= 0) return found;
  // A border was met: the rest lies the other way.
  for (h = opposite_[start]; h >= 0; h = opposite_[h]) {
    h = next(h);
    found.push_back(h / 3);
  }
  return found;
}

bool FlippableMesh::flip(Index h) {
  const Index o = opposite_[h];
  if (o < 0) return false;
  const Index a = source(h), b = target(h), c = apex(h), d = apex(o);
  for (Index f : faces_around(c)) {
    if ((faces_.row(f).array() == d).any()) return false;
  }
  const Index bc = opposite_[next(h)], ca = opposite_[previous(h)], ad = opposite_[next(o)],
              db = opposite_[previous(o)];
  const Index f = h / 3, g = o / 3;
  faces_.row(f) << c, a, d;
  faces_.row(g) << d, b, c;
  join(3 * f, ca);
  join(3 * f + 1, ad);
  join(3 * g, db);
  join(3 * g + 1, bc);
  join(3 * f + 2, 3 * g + 2);
  outgoing_[c] = 3 * f;
  outgoing_[a] = 3 * f + 1;
  outgoing_[d] = 3 * g;
  outgoing_[b] = 3 * g + 1;
  return true;
}

void FlippableMesh::join(Index h, Index o) {
  opposite_[h] = o;
  if (o >= 0) opposite_[o] = h;
}

}  // namespace hdpea
