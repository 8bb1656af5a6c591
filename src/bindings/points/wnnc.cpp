// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/wnnc.hpp"

#include "bindings/bindings.hpp"

void register_wnnc(nb::module_& module) {
  using hdpea::WnncOptions;
  nb::class_<WnncOptions>(module, "WnncOptions", "How the winding number is smoothed.")
      .def(nb::init<>())
      .def_rw("spacings_wide", &WnncOptions::spacings_wide, "The last width, in spacings of the points.");
  module.def("wnnc_normals", &hdpea::wnnc_normals, "points"_a, "options"_a, "progress"_a = nb::none(), ReleaseGil(),
             "Unit normals (n, 3) that point out of what the points enclose, by the winding number.");
}
