// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/hole_filling.hpp"

#include "bindings/bindings.hpp"

void register_hole_filling(nb::module_& module) {
  using hdpea::FilledMesh;
  nb::class_<FilledMesh>(module, "FilledMesh", "A mesh whose holes are filled up to a size.")
      .def_ro("vertices", &FilledMesh::vertices, "(v, 3) float64: the given ones, then the centres of fans")
      .def_ro("faces", &FilledMesh::faces, "(f, 3) int64: the given ones, then the patches")
      .def_ro("filled", &FilledMesh::filled)
      .def_ro("left", &FilledMesh::left);
  module.def("fill_holes", &hdpea::fill_holes, "vertices"_a, "faces"_a, "max_size"_a, "progress"_a = nb::none(),
             ReleaseGil(), "Fill holes whose size, 4 area / perimeter of the patch, is at most max_size.");
}
