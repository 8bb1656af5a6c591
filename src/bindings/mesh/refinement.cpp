// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/refinement.hpp"

#include "bindings/bindings.hpp"

void register_refinement(nb::module_& module) {
  using hdpea::RefinementOptions;
  nb::class_<RefinementOptions>(module, "RefinementOptions", "How a mesh is fitted to a cloud.")
      .def(nb::init<>())
      .def_static("within_error", &RefinementOptions::within_error)
      .def_rw("rounds", &RefinementOptions::rounds);
  module.def("refine_vertices", &hdpea::refine_vertices, "vertices"_a, "faces"_a, "points"_a, "normals"_a, "options"_a,
             "progress"_a = nb::none(), "fixed"_a = hdpea::Mask(), ReleaseGil(),
             "Move the vertices so that the faces run through the cloud, by least squares.");
}
