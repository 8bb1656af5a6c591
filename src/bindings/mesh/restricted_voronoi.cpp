// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/restricted_voronoi.hpp"

#include "bindings/bindings.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"

void register_restricted_voronoi(nb::module_& module) {
  using hdpea::Candidates;
  nb::class_<Candidates>(module, "Candidates", "Triangles dual to restricted Voronoi vertices, and the cells' areas.")
      .def(nb::init<hdpea::Faces, Eigen::VectorXi, Eigen::VectorXd>(), "triangles"_a, "counts"_a, "cell_areas"_a)
      .def_ro("triangles", &Candidates::triangles, "(t, 3) int64, rows ascending, in lexicographic order")
      .def_ro("counts", &Candidates::counts, "(t,) int32 in 1..3: how many of the three cells agree; 3 is T3")
      .def_ro("cell_areas", &Candidates::cell_areas, "(n,) area of each seed's cell");
  module.def("restricted_voronoi_candidates", &hdpea::restricted_voronoi_candidates, "seeds"_a, "bases"_a,
             "neighbors"_a, "radii"_a, ReleaseGil(),
             "Clip a disk of radius radii (n,) in the tangent plane of every seed (n, d) by the bisectors with its "
             "neighbours (n, k).");
  module.def("tangent_bases", &hdpea::tangent_bases, "coordinates"_a, "normals"_a, "neighbors"_a, ReleaseGil(),
             "Orthonormal tangent bases (n, 2 d): the plane across each normal (n, 3), and how the other coordinates "
             "change on it.");
  module.def("tangent_bases_across", &hdpea::tangent_bases_across, "normals"_a, ReleaseGil(),
             "Orthonormal bases (n, 6) of the planes across unit normals (n, 3).");
}
