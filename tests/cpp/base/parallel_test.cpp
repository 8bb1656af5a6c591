// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/parallel.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {
namespace {

TEST(Parallel, AnyLimitOfThreadsGivesTheSameResult) {
  for (int limit : {1, 2, 100000, std::numeric_limits<int>::max(), 0}) {
    set_thread_limit(limit);
    std::vector<Index> squares(10000, -1);
    parallel_for(10000, [&](Index i) { squares[i] = i * i; });
    for (Index i = 0; i < 10000; ++i) ASSERT_EQ(squares[i], i * i);
  }
}

TEST(Parallel, ANegativeLimitIsRefused) { EXPECT_THROW(set_thread_limit(-1), InvalidArgument); }

}  // namespace
}  // namespace hdpea
