// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/intersection_repair.hpp"

#include "bindings/bindings.hpp"

void register_intersection_repair(nb::module_& module) {
  using hdpea::RepairedMesh;
  nb::class_<RepairedMesh>(module, "RepairedMesh", "A mesh, and how many pairs of its faces cut each other.")
      .def_ro("vertices", &RepairedMesh::vertices, "(v, 3) float64")
      .def_ro("faces", &RepairedMesh::faces, "(f, 3) int64")
      .def_ro("self_intersections", &RepairedMesh::self_intersections, "Pairs of faces that cut each other.");
  module.def("repair_self_intersections", &hdpea::repair_self_intersections, "vertices"_a, "faces"_a, "points"_a,
             "farthest"_a, ReleaseGil(), "Mend faces that cut others, where that loses no points.");
}
