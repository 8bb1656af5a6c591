// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/signed_contraction.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hdpea {
namespace {

bool opposite(SignedSets& sets, Index i, Index j) { return sets.find(i).second != sets.find(j).second; }

TEST(SignedContraction, LetsManyOutweighOne) {
  // Two pairs: the strongest edge between them says that they are equal, and three others that they are opposite.
  const std::vector<SignedEdge> edges{{0, 1, 5}, {2, 3, 5}, {0, 2, 1}, {1, 3, -0.9}, {0, 3, -0.9}, {1, 2, -0.9}};
  SignedSets sets(4);
  join_by_weight(sets, edges);
  EXPECT_FALSE(opposite(sets, 0, 1));
  EXPECT_FALSE(opposite(sets, 2, 3));
  EXPECT_TRUE(opposite(sets, 0, 2));
}

TEST(SignedContraction, KeepsSetsThatAreJoinedAlready) {
  SignedSets sets(3);
  sets.join(0, 1, true);
  join_by_weight(sets, {{0, 1, 9}, {1, 2, -1}});
  EXPECT_TRUE(opposite(sets, 0, 1));
  EXPECT_TRUE(opposite(sets, 1, 2));
}

TEST(SignedContraction, LeavesApartWhatNoEdgeJoins) {
  SignedSets sets(4);
  join_by_weight(sets, {{0, 1, 1}, {2, 3, 0}});
  EXPECT_NE(sets.find(0).first, sets.find(2).first);
  EXPECT_EQ(sets.find(2).first, sets.find(3).first);
}

TEST(SignedContraction, DependsNotOnTheOrderOfEdges) {
  std::vector<SignedEdge> edges;
  for (Index i = 0; i < 60; ++i) {
    for (Index j : {i + 1, i + 7, i + 11}) edges.push_back({i, j % 60, double((i * 37 + j * 11) % 23 - 9)});
  }
  SignedSets some(60), others(60);
  join_by_weight(some, edges);
  join_by_weight(others, {edges.rbegin(), edges.rend()});
  for (Index i = 1; i < 60; ++i) EXPECT_EQ(opposite(some, 0, i), opposite(others, 0, i));
}

}  // namespace
}  // namespace hdpea
