// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/remeshing.hpp"

#include "bindings/bindings.hpp"

void register_remeshing(nb::module_& module) {
  using hdpea::RemeshingOptions;
  using hdpea::TriangleMesh;
  nb::class_<RemeshingOptions>(module, "RemeshingOptions",
                               "How a mesh is remeshed; lengths in the unit of the vertices.")
      .def(nb::init<>())
      .def_rw("edge_length", &RemeshingOptions::edge_length);
  nb::class_<TriangleMesh>(module, "TriangleMesh", "Vertices and faces.")
      .def_ro("vertices", &TriangleMesh::vertices, "(n, 3) float64")
      .def_ro("faces", &TriangleMesh::faces, "(f, 3) int64");
  module.def("remesh_isotropically", &hdpea::remesh_isotropically, "vertices"_a, "faces"_a, "options"_a, ReleaseGil(),
             "Cover the same surface with near-isotropic triangles, sharp edges kept.");
}
