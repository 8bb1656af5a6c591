// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/jet_fitting.hpp"

#include "bindings/bindings.hpp"

void register_jet_fitting(nb::module_& module) {
  using hdpea::JetOptions;
  using hdpea::Jets;
  nb::class_<JetOptions>(module, "JetOptions", "How many neighbours a jet is fitted to.")
      .def(nb::init<>())
      .def_rw("least_neighbors", &JetOptions::least_neighbors)
      .def_rw("direction_error", &JetOptions::direction_error)
      .def_rw("curvature_error", &JetOptions::curvature_error);
  nb::class_<Jets>(module, "Jets", "Second-order shape of the surface at each point.")
      .def_ro("curvature", &Jets::curvature, "signed; NaN where it cannot be fitted")
      .def_ro("normals", &Jets::normals, "(n, 3) float64, of the fitted surface")
      .def_ro("curvature_error", &Jets::curvature_error, "(n,) float64 standard error of k1 - k2, 1 / length")
      .def_ro("fitted", &Jets::fitted, "(n,) int64, how many neighbours were used");
  module.def("fit_jets", &hdpea::fit_jets, "points"_a, "normals"_a, "neighbors"_a, "options"_a = JetOptions{},
             ReleaseGil(), "Fit a quadratic height function to each point and its neighbours.");
}
