// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/contrary_patches.hpp"

namespace hdpea {
namespace {

struct Patch {
  std::vector<Index> faces;
  std::vector<Index> neck;  ///< its faces beside the rest, once for each edge
  bool hangs() const { return 4 * neck.size() * neck.size() <= faces.size(); }
};

/// The connected faces against their points that a face is one of.
Patch patch_of(Index face, const IncrementalManifold& mesh, const std::vector<bool>& against, std::vector<bool>& seen) {
  Patch patch;
  std::vector<Index> open{face};
  seen[face] = true;
  while (!open.empty()) {
    const Index f = open.back();
    open.pop_back();
    patch.faces.push_back(f);
    const Triangle& triangle = mesh.triangles()[f];
    for (int i = 0; i < 3; ++i) {
      for (const Index other : mesh.faces_at(triangle[i], triangle[(i + 1) % 3])) {
        if (other < 0 || other == f) continue;
        if (!against[other]) {
          patch.neck.push_back(f);
        } else if (!seen[other]) {
          seen[other] = true;
          open.push_back(other);
        }
      }
    }
  }
  return patch;
}

}  // namespace

HangingPatches find_hanging_patches(const IncrementalManifold& mesh, const std::vector<bool>& against,
                                    Index least_faces) {
  const std::size_t count = mesh.triangles().size();
  HangingPatches found{std::vector<bool>(count, false), std::vector<bool>(count, false)};
  std::vector<bool> seen(count, false);
  for (Index face = 0; face < static_cast<Index>(count); ++face) {
    if (!against[face] || seen[face]) continue;
    const Patch patch = patch_of(face, mesh, against, seen);
    if (static_cast<Index>(patch.faces.size()) < least_faces || !patch.hangs()) continue;
    ++found.count;
    for (const Index f : patch.faces) found.turned[f] = true;
    for (const Index f : patch.neck) found.cut[f] = true;
  }
  return found;
}

}  // namespace hdpea
