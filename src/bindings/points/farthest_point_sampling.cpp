// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/farthest_point_sampling.hpp"

#include <nanobind/stl/vector.h>

#include "bindings/bindings.hpp"

void register_farthest_point_sampling(nb::module_& module) {
  module.def("farthest_point_sampling", &hdpea::farthest_point_sampling, "points"_a, "count"_a,
             "first"_a = std::vector<hdpea::Index>{0}, "progress"_a = nb::none(), ReleaseGil(),
             "Indices (count) int64 of points (n, d), each the farthest from those before it, but for the "
             "first ones, which are given; ties by index.");
}
