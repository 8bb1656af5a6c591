// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/wnnc.hpp"

#include "bindings.hpp"

void register_wnnc(nb::module_& module) {
  using hdpea::WnncOptions;
  nb::class_<WnncOptions>(module, "WnncOptions", "How the normals are iterated; see wnnc.hpp.")
      .def(nb::init<>())
      .def_rw("iterations", &WnncOptions::iterations)
      .def_rw("first_width", &WnncOptions::first_width, "of the bounding box's diagonal")
      .def_rw("spacings_wide", &WnncOptions::spacings_wide, "least last width, in spacings")
      .def_rw("noises_wide", &WnncOptions::noises_wide, "least last width, in standard deviations of the noise");
  module.def("wnnc_normals", &hdpea::wnnc_normals, "points"_a, "options"_a = WnncOptions(), "progress"_a = nb::none(),
             ReleaseGil(), "Unit normals (n, 3) that point out of what the points enclose, by the winding number.");
}
