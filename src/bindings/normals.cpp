// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/normals.hpp"

#include "bindings.hpp"

void register_normals(nb::module_& module) {
  module.def("estimate_normals", &hdpea::estimate_normals, "points"_a, "neighbors"_a, ReleaseGil(),
             "Unoriented unit normals (n, 3) by PCA of each point's neighbours (n, k).");
  module.def("orient_normals", &hdpea::orient_normals, "points"_a, "normals"_a, "neighbors"_a, ReleaseGil(),
             "Give normals (n, 3) one consistent orientation; their signs on entry do not matter.");
  module.def("orientation_consistency", &hdpea::orientation_consistency, "points"_a, "normals"_a, "neighbors"_a,
             ReleaseGil(), "Share of neighbours whose signs agree: 1 for oriented normals, 0.5 for random signs.");
}
