// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/anisotropic_remeshing.hpp"

#include "bindings/bindings.hpp"

void register_anisotropic_remeshing(nb::module_& module) {
  using hdpea::EmbeddedCloud, hdpea::EmbeddedMesh;
  nb::class_<EmbeddedMesh>(module, "EmbeddedMesh", "A mesh of an embedded surface.")
      .def_ro("vertices", &EmbeddedMesh::vertices, "(v, 3) float64")
      .def_ro("coordinates", &EmbeddedMesh::coordinates, "(v, d) float64: on the embedded surface")
      .def_ro("faces", &EmbeddedMesh::faces, "(f, 3) int64");
  // The options are for the core's own tests: nobody sets them from Python.
  module.def(
      "remesh_anisotropically",
      [](const hdpea::PointsRef& vertices, const hdpea::CoordinatesRef& coordinates, const hdpea::FacesRef& faces,
         const hdpea::CoordinatesRef& cloud, const hdpea::CoordinatesRef& bases, const hdpea::PointsRef& normals,
         const hdpea::Progress& progress, const hdpea::MaskRef& fixed) {
        const EmbeddedCloud surface{cloud, bases, normals};
        return hdpea::remesh_anisotropically(vertices, coordinates, faces, surface, {}, progress, fixed);
      },
      "vertices"_a, "coordinates"_a, "faces"_a, "cloud"_a, "bases"_a, "normals"_a, "progress"_a = nb::none(),
      "fixed"_a = hdpea::Mask(), ReleaseGil(),
      "Make the triangles of a mesh as equilateral in its embedding as can be, without leaving the points.");
}
