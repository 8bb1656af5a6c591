// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/sheets.hpp"

#include "bindings.hpp"

void register_sheets(nb::module_& module) {
  using hdpea::SheetOptions;
  nb::class_<SheetOptions>(module, "SheetOptions", "When two nearby points lie on the same sheet.")
      .def(nb::init<>())
      .def_rw("min_cosine", &SheetOptions::min_cosine)
      .def_rw("max_slope", &SheetOptions::max_slope)
      .def_rw("rim_gap", &SheetOptions::rim_gap)
      .def_rw("rim_distance", &SheetOptions::rim_distance);
  module.def("sheet_neighbors", &hdpea::sheet_neighbors, "points"_a, "normals"_a, "neighbors"_a,
             "options"_a = SheetOptions(), ReleaseGil(), "Keep the neighbours on the same sheet; pad with -1.");
  module.def("blended_normals", &hdpea::blended_normals, "normals"_a, "sheet_neighbors"_a, "count"_a = 8, ReleaseGil(),
             "The mean normal of each point and its nearest neighbours of the sheet.");
}
