// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/manifold_extraction.hpp"

#include "bindings/bindings.hpp"

void register_manifold_extraction(nb::module_& module) {
  using hdpea::ExtractedMesh;
  using hdpea::ExtractionCounts;
  using hdpea::ExtractionOptions;
  nb::class_<ExtractionOptions>(module, "ExtractionOptions", "What is refused; angles in degrees.")
      .def(nb::init<>())
      .def_ro("max_circumradius", &ExtractionOptions::max_circumradius)
      .def_rw("min_component_faces", &ExtractionOptions::min_component_faces);
  nb::class_<ExtractionCounts>(module, "ExtractionCounts",
                               "How many candidates were kept, and why the others were refused.")
      .def_ro("t3", &ExtractionCounts::t3)
      .def_ro("t12", &ExtractionCounts::t12)
      .def_ro("t3_kept", &ExtractionCounts::t3_kept)
      .def_ro("t12_kept", &ExtractionCounts::t12_kept)
      .def_ro("refused_edge", &ExtractionCounts::refused_edge)
      .def_ro("refused_link", &ExtractionCounts::refused_link)
      .def_ro("refused_orientation", &ExtractionCounts::refused_orientation)
      .def_ro("refused_fold", &ExtractionCounts::refused_fold)
      .def_ro("refused_normal", &ExtractionCounts::refused_normal)
      .def_ro("refused_size", &ExtractionCounts::refused_size)
      .def_ro("refused_sides", &ExtractionCounts::refused_sides)
      .def_ro("refused_loose", &ExtractionCounts::refused_loose)
      .def_ro("dropped_components", &ExtractionCounts::dropped_components)
      .def_ro("dropped_faces", &ExtractionCounts::dropped_faces)
      .def_ro("turned_patches", &ExtractionCounts::turned_patches)
      .def_ro("split_vertices", &ExtractionCounts::split_vertices);
  nb::class_<ExtractedMesh>(module, "ExtractedMesh", "A manifold mesh and how it came about.")
      .def_ro("faces", &ExtractedMesh::faces, "(f, 3) int64")
      .def_ro("sources", &ExtractedMesh::sources, "(v,) int64: the seed of each vertex")
      .def_ro("counts", &ExtractedMesh::counts);
  module.def("extract_manifold", &hdpea::extract_manifold, "coordinates"_a, "normals"_a, "disk_radii"_a, "candidates"_a,
             "options"_a, ReleaseGil(), "Choose an edge- and vertex-manifold, oriented mesh from the candidates.");
}
