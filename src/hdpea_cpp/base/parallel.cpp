// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/parallel.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <memory>

#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {

void set_thread_limit(int count) {
  require(count >= 0, "the number of threads must be 0 (no limit) or more");
  // TBB keeps a limit for as long as its control object lives.
  static std::unique_ptr<tbb::global_control> limit;
  limit.reset();
  if (count > 0) {
    // TBB reserves memory for each thread that it is allowed.
    constexpr int most = 1024;
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, std::min(count, most));
  }
}

}  // namespace hdpea
