// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/signed_sets.hpp"

#include <gtest/gtest.h>

namespace hdpea {
namespace {

TEST(SignedSets, EachMemberStartsAlone) {
  SignedSets sets(2);
  sets.add();
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(sets.find(i), std::pair(i, false));
}

TEST(SignedSets, KnowTheSignsAlongAChain) {
  SignedSets sets(4);
  sets.join(0, 1, true);
  sets.join(1, 2, true);
  sets.join(2, 3, false);
  EXPECT_EQ(sets.find(1), std::pair(Index{0}, true));
  EXPECT_EQ(sets.find(3), std::pair(Index{0}, false));  // opposite twice
}

TEST(SignedSets, JoiningTwoSetsFlipsOneAsAWhole) {
  SignedSets sets(4);
  sets.join(0, 1, true);
  sets.join(2, 3, false);
  sets.join(1, 3, false);  // 1 is opposite to 0, so 3 and with it 2 are
  EXPECT_EQ(sets.find(2), std::pair(Index{0}, true));
  EXPECT_EQ(sets.find(3), std::pair(Index{0}, true));
  EXPECT_EQ(sets.size(3), 4);
}

TEST(SignedSets, MembersOfOneSetKeepTheirSigns) {
  SignedSets sets(2);
  sets.join(0, 1, true);
  sets.join(0, 1, false);
  EXPECT_TRUE(sets.find(1).second);
  EXPECT_EQ(sets.size(0), 2);
}

}  // namespace
}  // namespace hdpea
