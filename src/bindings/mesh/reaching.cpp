// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/reaching.hpp"

#include "bindings/bindings.hpp"

void register_reaching(nb::module_& module) {
  using hdpea::ReachedMesh;
  nb::class_<ReachedMesh>(module, "ReachedMesh", "A mesh that was drawn to points it had missed.")
      .def_ro("vertices", &ReachedMesh::vertices, "(v, 3) float64: the given ones, then new ones")
      .def_ro("faces", &ReachedMesh::faces, "(f, 3) int64")
      .def_ro("reached", &ReachedMesh::reached, "The point that each new vertex lies at.");
  module.def("reach_points", &hdpea::reach_points, "vertices"_a, "faces"_a, "points"_a, "normals"_a, "far"_a,
             ReleaseGil(), "Draw a mesh to the points that are far from it.");
}
