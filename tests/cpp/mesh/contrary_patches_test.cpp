// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/contrary_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/pinched_vertices.hpp"

namespace hdpea {
namespace {

constexpr Index kSide = 8;

/// A square of 8 x 8 vertices from the given one on, facing up.
void add_square(std::vector<Triangle>& faces, Index first) {
  for (Index y = 0; y + 1 < kSide; ++y) {
    for (Index x = 0; x + 1 < kSide; ++x) {
      const Index a = first + y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
      faces.push_back({a, b, d});
      faces.push_back({a, d, c});
    }
  }
}

/// Two squares side by side, joined along the given number of edges: 8 x 14 faces and twice as many as edges.
std::vector<Triangle> joined_squares(Index edges) {
  std::vector<Triangle> faces;
  add_square(faces, 0);
  add_square(faces, kSide * kSide);
  for (Index y = 0; y < edges; ++y) {
    const Index a = y * kSide + kSide - 1, b = kSide * kSide + y * kSide, c = a + kSide, d = b + kSide;
    faces.push_back({a, b, d});
    faces.push_back({a, d, c});
  }
  return faces;
}

/// Those with a corner in the second square, as against their points.
std::vector<bool> second_square(const std::vector<Triangle>& faces) {
  std::vector<bool> against;
  for (const Triangle& face : faces) against.push_back(*std::max_element(face.begin(), face.end()) >= kSide * kSide);
  return against;
}

MeshCheck check_of(const std::vector<Triangle>& triangles) {
  Faces faces;
  Eigen::Vector<Index, Eigen::Dynamic> sources;
  split_pinched_vertices(triangles, 2 * kSide * kSide, faces, sources);
  return check_mesh(Points::Random(sources.size(), 3), faces);
}

/// Turns the patches of oriented faces that hang on the rest, and takes the faces at the necks away.
Index turn_hanging_patches(std::vector<Triangle>& faces, const std::vector<bool>& against, Index least_faces) {
  IncrementalManifold mesh(2 * kSide * kSide);
  for (Triangle face : faces) {
    std::sort(face.begin(), face.end());
    mesh.insert(face);
  }
  const HangingPatches found = find_hanging_patches(mesh, against, least_faces);
  std::vector<Triangle> kept;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (found.turned[f]) std::swap(faces[f][1], faces[f][2]);
    if (!found.cut[f]) kept.push_back(faces[f]);
  }
  faces = kept;
  return found.count;
}

TEST(ContraryPatches, APatchThatHangsByANeckIsCutOffAndTurned) {
  std::vector<Triangle> faces = joined_squares(2);
  const std::vector<Triangle> before = faces;
  EXPECT_EQ(turn_hanging_patches(faces, second_square(before), 16), 1);
  const MeshCheck check = check_of(faces);
  EXPECT_EQ(check.components, 2);
  EXPECT_TRUE(check.manifold() && check.oriented());
  EXPECT_EQ(faces.front(), before.front());
  Triangle turned = before[2 * (kSide - 1) * (kSide - 1)];
  std::swap(turned[1], turned[2]);
  EXPECT_EQ(faces[2 * (kSide - 1) * (kSide - 1)], turned);
  EXPECT_GE(faces.size() + 4, before.size());
}

TEST(ContraryPatches, ASmallPatchStays) {
  std::vector<Triangle> faces = joined_squares(2);
  const std::vector<Triangle> before = faces;
  EXPECT_EQ(turn_hanging_patches(faces, second_square(before), 200), 0);
  EXPECT_EQ(faces, before);
}

TEST(ContraryPatches, HalfOfASurfaceIsNotCutOff) {
  std::vector<Triangle> faces = joined_squares(kSide - 1);
  std::vector<bool> against(faces.size(), false);
  for (std::size_t f = 0; f < faces.size(); ++f) against[f] = faces[f][0] % kSide < 5 && faces[f][0] < kSide * kSide;
  const std::vector<Triangle> before = faces;
  EXPECT_EQ(turn_hanging_patches(faces, against, 16), 0);
  EXPECT_EQ(faces, before);
}

TEST(ContraryPatches, AFaceHereAndThereStays) {
  std::vector<Triangle> faces = joined_squares(2);
  std::vector<bool> against(faces.size(), false);
  for (std::size_t f = 0; f < faces.size(); f += 9) against[f] = true;
  const std::vector<Triangle> before = faces;
  EXPECT_EQ(turn_hanging_patches(faces, against, 16), 0);
  EXPECT_EQ(faces, before);
}

}  // namespace
}  // namespace hdpea
