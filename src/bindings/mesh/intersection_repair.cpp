// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/intersection_repair.hpp"

#include "bindings/bindings.hpp"

void register_intersection_repair(nb::module_& module) {
  module.def("repair_self_intersections", &hdpea::repair_self_intersections, "vertices"_a, "faces"_a, ReleaseGil(),
             "Mend faces that cut others.");
}
