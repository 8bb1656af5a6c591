// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/simplification.hpp"

#include "bindings/bindings.hpp"

void register_simplification(nb::module_& module) {
  using hdpea::MeshBudget, hdpea::SimplificationOptions, hdpea::SimplifiedMesh;
  nb::class_<MeshBudget>(module, "MeshBudget", "No more vertices and no more faces than these.")
      .def(nb::init<>())
      .def_rw("vertices", &MeshBudget::vertices)
      .def_rw("faces", &MeshBudget::faces);
  nb::class_<SimplificationOptions>(module, "SimplificationOptions", "What an edge collapse costs.")
      .def(nb::init<>())
      .def_rw("evenness", &SimplificationOptions::evenness)
      .def_rw("border", &SimplificationOptions::border);
  nb::class_<SimplifiedMesh>(module, "SimplifiedMesh", "A mesh whose edges were collapsed.")
      .def_ro("vertices", &SimplifiedMesh::vertices, "(v, 3) float64")
      .def_ro("coordinates", &SimplifiedMesh::coordinates, "(v, d) float64: the centroids of what they stand for")
      .def_ro("faces", &SimplifiedMesh::faces, "(f, 3) int64");
  module.def("simplify_mesh", &hdpea::simplify_mesh, "vertices"_a, "coordinates"_a, "faces"_a, "budget"_a, "options"_a,
             "progress"_a = nb::none(), ReleaseGil(),
             "Collapse edges, the least loss first, until a mesh is small enough.");
}
