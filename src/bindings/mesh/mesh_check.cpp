// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/mesh_check.hpp"

#include <nanobind/stl/optional.h>

#include "bindings/bindings.hpp"
#include "hdpea_cpp/mesh/self_intersections.hpp"

void register_mesh_check(nb::module_& module) {
  using hdpea::MeshCheck;
  nb::class_<MeshCheck>(module, "MeshCheck", "What a mesh is, in counts.")
      .def_ro("vertices", &MeshCheck::vertices)
      .def_ro("faces", &MeshCheck::faces)
      .def_ro("edges", &MeshCheck::edges)
      .def_ro("boundary_edges", &MeshCheck::boundary_edges, "Edges of one face.")
      .def_ro("nonmanifold_edges", &MeshCheck::nonmanifold_edges, "Edges of three faces or more.")
      .def_ro("nonmanifold_vertices", &MeshCheck::nonmanifold_vertices,
              "Vertices whose link is neither a path nor a cycle.")
      .def_ro("inconsistent_edges", &MeshCheck::inconsistent_edges, "Edges both faces traverse in one direction.")
      .def_ro("degenerate_faces", &MeshCheck::degenerate_faces, "Faces that repeat an index or have no area.")
      .def_ro("repeated_index_faces", &MeshCheck::repeated_index_faces)
      .def_ro("duplicate_faces", &MeshCheck::duplicate_faces, "Faces with the corners of an earlier one.")
      .def_ro("unreferenced_vertices", &MeshCheck::unreferenced_vertices)
      .def_ro("boundary_loops", &MeshCheck::boundary_loops)
      .def_ro("components", &MeshCheck::components, "Sets of faces connected across edges.")
      .def_ro("euler_characteristic", &MeshCheck::euler_characteristic)
      .def_prop_ro("manifold", &MeshCheck::manifold)
      .def_prop_ro("oriented", &MeshCheck::oriented)
      .def_prop_ro("closed", &MeshCheck::closed)
      .def_prop_ro("genus", &MeshCheck::genus, "Handles of all components; None unless manifold and oriented.");
  module.def("check_mesh", &hdpea::check_mesh, "vertices"_a, "faces"_a, ReleaseGil(),
             "Count the defects and the topology of a mesh (n, 3), (f, 3).");
  module.def("count_self_intersections", &hdpea::count_self_intersections, "vertices"_a, "faces"_a, ReleaseGil(),
             "Pairs of faces that meet in more than the vertices and edges they share.");
}
