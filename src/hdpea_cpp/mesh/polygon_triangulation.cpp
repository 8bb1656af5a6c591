// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/polygon_triangulation.hpp"

#include <limits>
#include <utility>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

std::vector<PolygonTriangle> cheapest_triangulation(int corners, const std::function<double(int, int, int)>& cost) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (corners < 3) return {};
  // Of the part of the polygon from one corner to another: its cost, and the third corner of the triangle on the chord.
  Eigen::MatrixXd least = Eigen::MatrixXd::Zero(corners, corners);
  Eigen::MatrixXi third = Eigen::MatrixXi::Constant(corners, corners, -1);
  for (int span = 2; span < corners; ++span) {
    for (int from = 0; from + span < corners; ++from) {
      const int to = from + span;
      double best = kInfinity;
      for (int middle = from + 1; middle < to; ++middle) {
        const double parts = least(from, middle) + least(middle, to);
        if (parts >= best) continue;
        const double whole = parts + cost(from, middle, to);
        if (whole < best) best = whole, third(from, to) = middle;
      }
      least(from, to) = best;
    }
  }
  if (third(0, corners - 1) < 0) return {};
  std::vector<PolygonTriangle> triangles;
  std::vector<std::pair<int, int>> chords{{0, corners - 1}};
  while (!chords.empty()) {
    const auto [from, to] = chords.back();
    chords.pop_back();
    if (to - from < 2) continue;
    const int middle = third(from, to);
    triangles.push_back({from, middle, to});
    chords.emplace_back(from, middle);
    chords.emplace_back(middle, to);
  }
  return triangles;
}

}  // namespace hdpea
