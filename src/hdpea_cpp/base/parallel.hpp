// SPDX-License-Identifier: GPL-3.0-or-later
// Loops whose result cannot depend on the number of threads: each index writes only its own output.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Limits the core to `count` threads from now on; 0 lifts the limit.
void set_thread_limit(int count);

/// Calls body(i) for every i in [0, n), in any order.
template <class Body>
void parallel_for(Index n, Body&& body, Index grain = 256) {
  tbb::parallel_for(tbb::blocked_range<Index>(0, n, grain), [&](const tbb::blocked_range<Index>& range) {
    for (Index i = range.begin(); i < range.end(); ++i) body(i);
  });
}

}  // namespace hdpea
