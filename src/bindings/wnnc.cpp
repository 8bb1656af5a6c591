// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/wnnc.hpp"

#include "bindings.hpp"

void register_wnnc(nb::module_& module) {
  // The options are for the core's own tests: nobody sets them from Python.
  module.def(
      "wnnc_normals",
      [](const hdpea::PointsRef& points, const hdpea::Progress& progress) {
        return hdpea::wnnc_normals(points, {}, progress);
      },
      "points"_a, "progress"_a = nb::none(), ReleaseGil(),
      "Unit normals (n, 3) that point out of what the points enclose, by the winding number.");
}
