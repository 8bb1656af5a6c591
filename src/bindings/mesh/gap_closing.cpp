// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/gap_closing.hpp"

#include "bindings/bindings.hpp"

void register_gap_closing(nb::module_& module) {
  module.def("close_gaps", &hdpea::close_gaps, "vertices"_a, "faces"_a, "normals"_a, "max_size"_a, ReleaseGil(),
             "Close the long narrow gaps along the rims of thin walls, up to a size.");
}
