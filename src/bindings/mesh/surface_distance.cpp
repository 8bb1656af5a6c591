// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/surface_distance.hpp"

#include "bindings/bindings.hpp"

void register_surface_distance(nb::module_& module) {
  using hdpea::SurfacePoints;
  nb::class_<SurfacePoints>(module, "SurfacePoints", "Points of a triangle mesh, one row per query.")
      .def_ro("distance", &SurfacePoints::distance, "(m) distance from the query.")
      .def_ro("face", &SurfacePoints::face, "(m) int64 the face the point lies on, the lowest of several.")
      .def_ro("barycentric", &SurfacePoints::barycentric, "(m, 3) weights of the face's corners.")
      .def_ro("position", &SurfacePoints::position, "(m, 3)");
  module.def("closest_surface_points", &hdpea::closest_surface_points, "vertices"_a, "faces"_a, "queries"_a,
             ReleaseGil(), "The point of the mesh (n, 3), (f, 3) closest to each query (m, 3).");
}
