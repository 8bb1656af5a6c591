// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/creases.hpp"

#include "bindings/bindings.hpp"

void register_creases(nb::module_& module) {
  using hdpea::Creases;
  nb::class_<Creases>(module, "Creases", "Sharp edges that points show.")
      .def_prop_ro(
          "positions", [](const Creases& creases) { return hdpea::crease_positions(creases.samples); },
          "(m, 3) float64: places on the creases, about two to a spacing of the points")
      .def_prop_ro(
          "corners", [](const Creases& creases) { return hdpea::crease_corners(creases); },
          "(c, 3) float64: where creases meet, or one bends by 30 degrees within few spacings");
  // The options are for the core's own tests: nobody sets them from Python.
  module.def(
      "find_creases",
      [](const hdpea::PointsRef& points, const hdpea::PointsRef& normals) {
        return hdpea::find_creases(points, normals);
      },
      "points"_a, "normals"_a, ReleaseGil(), "Find the sharp edges that points show.");
}
