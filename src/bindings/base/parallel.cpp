// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/parallel.hpp"

#include "bindings/bindings.hpp"

void register_parallel(nb::module_& module) {
  module.def("set_thread_limit", &hdpea::set_thread_limit, "count"_a,
             "Limit the core to `count` threads from now on; 0 lifts the limit.");
}
