// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/polygon_triangulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace hdpea {
namespace {

/// The least cost of all triangulations of the corners from one to another, by trying them.
double least(int from, int to, const std::function<double(int, int, int)>& cost) {
  if (to - from < 2) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (int k = from + 1; k < to; ++k) {
    best = std::min(best, cost(from, k, to) + least(from, k, cost) + least(k, to, cost));
  }
  return best;
}

TEST(PolygonTriangulation, CostsNoMoreThanAnyOther) {
  const auto cost = [](int i, int j, int k) { return double((7 * i + 5 * j * j + 3 * k * i) % 11); };
  for (int corners = 3; corners < 10; ++corners) {
    const auto triangles = cheapest_triangulation(corners, cost);
    ASSERT_EQ(static_cast<int>(triangles.size()), corners - 2);
    double sum = 0;
    for (const auto& [i, j, k] : triangles) {
      EXPECT_TRUE(i < j && j < k);
      sum += cost(i, j, k);
    }
    EXPECT_EQ(sum, least(0, corners - 1, cost));
  }
}

TEST(PolygonTriangulation, LeavesOutWhatIsForbidden) {
  const auto without = [](int chord_from, int chord_to) {
    return cheapest_triangulation(4, [=](int i, int j, int k) {
      const bool has = (i == chord_from || j == chord_from) && (j == chord_to || k == chord_to);
      return has ? std::numeric_limits<double>::infinity() : 1.0;
    });
  };
  for (const auto& [i, j, k] : without(0, 2)) EXPECT_TRUE((i == 0 && j == 1 && k == 3) || (i == 1 && j == 2 && k == 3));
  EXPECT_EQ(without(0, 2).size(), 2U);
}

TEST(PolygonTriangulation, IsEmptyWhereThereIsNone) {
  EXPECT_TRUE(cheapest_triangulation(2, [](int, int, int) { return 1.0; }).empty());
  const auto forbidden = [](int, int, int) { return std::numeric_limits<double>::infinity(); };
  EXPECT_TRUE(cheapest_triangulation(5, forbidden).empty());
}

}  // namespace
}  // namespace hdpea
