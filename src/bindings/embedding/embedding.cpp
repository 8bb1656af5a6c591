// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/embedding/embedding.hpp"

#include <nanobind/stl/optional.h>

#include "bindings/bindings.hpp"

void register_embedding(nb::module_& module) {
  using hdpea::Curvature;
  using hdpea::EmbeddingOptions;
  nb::class_<Curvature>(module, "Curvature", "Principal curvatures and the first principal direction.")
      .def_rw("principal", &Curvature::principal, "(n, 2) float64, |k1| >= |k2|, 1 / length")
      .def_rw("direction1", &Curvature::direction1, "(n, 3) float64 unit tangents");
  module.def("estimate_curvature", &hdpea::estimate_curvature, "points"_a, "normals"_a, "neighbors"_a, "radius"_a,
             ReleaseGil(), "Fit the shape operator to the change of the normals within a radius.");
  nb::class_<EmbeddingOptions>(module, "EmbeddingOptions",
                               "How the embedding is solved for; lengths in the unit of the points.")
      .def(nb::init<>())
      .def_rw("metric_scale", &EmbeddingOptions::metric_scale)
      .def_rw("max_stretch", &EmbeddingOptions::max_stretch)
      .def_rw("bending_length", &EmbeddingOptions::bending_length)
      .def_rw("iterations", &EmbeddingOptions::iterations);
  module.def("solve_embedding", &hdpea::solve_embedding, "points"_a, "normals"_a, "curvature"_a, "triangles"_a,
             "weights"_a, "options"_a, "progress"_a = nb::none(), "initial"_a = nb::none(), ReleaseGil(),
             "Solve for psi (n, 5) such that x -> [x, psi(x)] is isometric under the curvature metric.");
}
