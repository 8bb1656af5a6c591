// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/piece_sides.hpp"

#include "bindings/bindings.hpp"

void register_piece_sides(nb::module_& module) {
  using hdpea::FacedMesh;
  nb::class_<FacedMesh>(module, "FacedMesh", "A mesh whose closed pieces face out.")
      .def_ro("faces", &FacedMesh::faces, "(f, 3) int64")
      .def_ro("turned", &FacedMesh::turned, "Closed pieces that were inside out.")
      .def_ro("within", &FacedMesh::within, "Pieces within another that face inwards, as cavities do.")
      .def_ro("sideless", &FacedMesh::sideless, "Share of the area in pieces so open that they have no inside.");
  module.def("face_outwards", &hdpea::face_outwards, "vertices"_a, "faces"_a, ReleaseGil(),
             "Turn closed pieces of negative volume, but for those within another one that is as good as closed.");
}
