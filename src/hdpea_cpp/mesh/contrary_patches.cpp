// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/contrary_patches.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace hdpea {
namespace {

using Adjacency = std::vector<std::array<Index, 3>>;

/// The faces beside each, over the edge that starts at each corner; -1 at the border.
Adjacency faces_beside(const std::vector<Triangle>& faces) {
  Adjacency beside(faces.size(), {-1, -1, -1});
  std::map<std::pair<Index, Index>, std::pair<std::size_t, int>> starts;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int i = 0; i < 3; ++i) starts[{faces[f][i], faces[f][(i + 1) % 3]}] = {f, i};
  for (const auto& [edge, start] : starts) {
    const auto twin = starts.find({edge.second, edge.first});
    if (twin != starts.end()) beside[start.first][start.second] = static_cast<Index>(twin->second.first);
  }
  return beside;
}

struct Patch {
  std::vector<std::size_t> faces;
  std::vector<std::size_t> neck;  ///< its faces beside the rest, once for each edge
  bool hangs() const { return 4 * neck.size() * neck.size() <= faces.size(); }
};

/// The connected faces against their points that a face is one of.
Patch patch_of(std::size_t face, const Adjacency& beside, const std::vector<bool>& against, std::vector<bool>& seen) {
  Patch patch;
  std::vector<std::size_t> open{face};
  seen[face] = true;
  while (!open.empty()) {
    const std::size_t f = open.back();
    open.pop_back();
    patch.faces.push_back(f);
    for (const Index other : beside[f]) {
      if (other < 0) continue;
      if (!against[other]) {
        patch.neck.push_back(f);
      } else if (!seen[other]) {
        seen[other] = true;
        open.push_back(static_cast<std::size_t>(other));
      }
    }
  }
  return patch;
}

}  // namespace

Index turn_hanging_patches(std::vector<Triangle>& faces, const std::vector<bool>& against, Index least_faces) {
  const Adjacency beside = faces_beside(faces);
  std::vector<bool> seen(faces.size(), false), cut(faces.size(), false);
  Index turned = 0;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (!against[face] || seen[face]) continue;
    const Patch patch = patch_of(face, beside, against, seen);
    if (static_cast<Index>(patch.faces.size()) < least_faces || !patch.hangs()) continue;
    ++turned;
    for (const std::size_t f : patch.faces) std::swap(faces[f][1], faces[f][2]);
    for (const std::size_t f : patch.neck) cut[f] = true;
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (!cut[f]) faces[kept++] = faces[f];
  faces.resize(kept);
  return turned;
}

}  // namespace hdpea
