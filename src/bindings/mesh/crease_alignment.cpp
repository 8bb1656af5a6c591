// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/crease_alignment.hpp"

#include "bindings/bindings.hpp"
#include "hdpea_cpp/mesh/crease_edges.hpp"

void register_crease_alignment(nb::module_& module) {
  module.def("align_to_creases", &hdpea::align_to_creases, "vertices"_a, "faces"_a, "creases"_a,
             "fixed"_a = hdpea::Mask(), ReleaseGil(),
             "Move vertices onto creases and flip edges, so that none runs across.");
  module.def("crease_edges", &hdpea::crease_edges, "vertices"_a, "faces"_a, "creases"_a, ReleaseGil(),
             "The (k, 2) edges of a mesh that run along creases.");
}
