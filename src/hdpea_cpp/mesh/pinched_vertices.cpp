// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/pinched_vertices.hpp"

namespace hdpea {
namespace {

/// A face's corner, as seen from its vertex.
struct Corner {
  Index face;
  int at;
  Index next, previous;
};

/// Numbers the fans among the corners of one vertex; corners of a fan share edges at the vertex.
int number_fans(const std::vector<Corner>& corners, std::vector<int>& fan_of) {
  fan_of.assign(corners.size(), -1);
  int fans = 0;
  for (std::size_t start = 0; start < corners.size(); ++start) {
    if (fan_of[start] >= 0) continue;
    std::vector<std::size_t> open{start};
    fan_of[start] = fans;
    while (!open.empty()) {
      const Corner& corner = corners[open.back()];
      open.pop_back();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const bool adjacent = corners[i].next == corner.previous || corners[i].previous == corner.next;
        if (fan_of[i] >= 0 || !adjacent) continue;
        fan_of[i] = fans;
        open.push_back(i);
      }
    }
    ++fans;
  }
  return fans;
}

}  // namespace

Index split_pinched_vertices(const std::vector<Triangle>& triangles, Index source_count, Faces& faces,
                             Eigen::Vector<Index, Eigen::Dynamic>& sources) {
  std::vector<std::vector<Corner>> corners_of(static_cast<std::size_t>(source_count));
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (int at = 0; at < 3; ++at) {
      const Triangle& t = triangles[f];
      corners_of[t[at]].push_back({static_cast<Index>(f), at, t[(at + 1) % 3], t[(at + 2) % 3]});
    }
  }
  faces.resize(static_cast<Index>(triangles.size()), 3);
  std::vector<Index> source_of;
  Index copies = 0;
  std::vector<int> fan_of;
  for (Index vertex = 0; vertex < source_count; ++vertex) {
    const auto& corners = corners_of[vertex];
    if (corners.empty()) continue;
    const int fans = number_fans(corners, fan_of);
    const Index first = static_cast<Index>(source_of.size());
    for (std::size_t i = 0; i < corners.size(); ++i) faces(corners[i].face, corners[i].at) = first + fan_of[i];
    source_of.insert(source_of.end(), static_cast<std::size_t>(fans), vertex);
    copies += fans - 1;
  }
  sources = Eigen::Map<Eigen::Vector<Index, Eigen::Dynamic>>(source_of.data(), static_cast<Index>(source_of.size()));
  return copies;
}

}  // namespace hdpea
