// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normals.hpp"

#include "bindings/bindings.hpp"

void register_normals(nb::module_& module) {
  module.def("estimate_normals", &hdpea::estimate_normals, "points"_a, "neighbors"_a, ReleaseGil(),
             "Unoriented unit normals (n, 3) by planes of each point's neighbours (n, k), sharp at creases.");
}
