// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/moving_least_squares.hpp"

#include "bindings/bindings.hpp"

void register_moving_least_squares(nb::module_& module) {
  using hdpea::SurfacePlaces;
  nb::class_<SurfacePlaces>(module, "SurfacePlaces", "Places on the surface that points sample.")
      .def_ro("points", &SurfacePlaces::points, "(n, 3) float64")
      .def_ro("normals", &SurfacePlaces::normals, "(n, 3) float64, of the fitted surface");
  // The options are for the core's own tests: nobody sets them from Python.
  module.def(
      "moving_least_squares",
      [](const hdpea::PointsRef& places, const hdpea::PointsRef& normals, const hdpea::PointsRef& points,
         const hdpea::NeighborsRef& neighbors) {
        return hdpea::moving_least_squares(places, normals, points, neighbors);
      },
      "places"_a, "normals"_a, "points"_a, "neighbors"_a, ReleaseGil(),
      "Move places along their normals onto the quadrics that fit the points there.");
}
