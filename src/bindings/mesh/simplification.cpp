// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/simplification.hpp"

#include "bindings/bindings.hpp"

void register_simplification(nb::module_& module) {
  using hdpea::MeshBudget, hdpea::SimplifiedMesh, hdpea::SimplificationOptions;
  nb::class_<MeshBudget>(module, "MeshBudget", "No more vertices and no more faces than these.")
      .def(nb::init<>())
      .def_rw("vertices", &MeshBudget::vertices)
      .def_rw("faces", &MeshBudget::faces);
  nb::class_<SimplifiedMesh>(module, "SimplifiedMesh", "A mesh whose edges were collapsed.")
      .def_ro("vertices", &SimplifiedMesh::vertices, "(v, 3) float64")
      .def_ro("coordinates", &SimplifiedMesh::coordinates,
              "(v, d) float64: the centroids of the parts that they represent")
      .def_ro("faces", &SimplifiedMesh::faces, "(f, 3) int64");
  // The options are for the core's own tests: nobody sets them from Python.
  module.def(
      "simplify_mesh",
      [](const hdpea::PointsRef& vertices, const hdpea::CoordinatesRef& coordinates, const hdpea::FacesRef& faces,
         const hdpea::PointsRef& points, const hdpea::PointsRef& normals, const MeshBudget& budget,
         const hdpea::Progress& progress, const hdpea::MaskRef& fixed) {
        return hdpea::simplify_mesh(vertices, coordinates, faces, points, normals, budget, {}, progress, fixed);
      },
      "vertices"_a, "coordinates"_a, "faces"_a, "points"_a, "normals"_a, "budget"_a, "progress"_a = nb::none(),
      "fixed"_a = hdpea::Mask(), ReleaseGil(), "Collapse edges, the cheapest first, until a mesh is small enough.");
  module.def(
      "simplify_within",
      [](const hdpea::PointsRef& vertices, const hdpea::CoordinatesRef& coordinates, const hdpea::FacesRef& faces,
         const hdpea::PointsRef& points, const hdpea::PointsRef& normals,
         const Eigen::Ref<const Eigen::VectorXd>& radii, double error, const hdpea::Progress& progress) {
        return hdpea::simplify_within(vertices, coordinates, faces, points, normals, radii, error,
                                      SimplificationOptions::within_error(), progress);
      },
      "vertices"_a, "coordinates"_a, "faces"_a, "points"_a, "normals"_a, "radii"_a, "error"_a,
      "progress"_a = nb::none(), ReleaseGil(),
      "Collapse edges as long as the mesh stays within an error of the points, both ways.");
}
