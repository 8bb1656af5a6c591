// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/bindings.hpp"

NB_MODULE(_core, module) {
  module.doc() = "The compiled core of hdpea: arrays in, arrays out.";
  register_errors(module);
  register_creases(module);
  register_crease_alignment(module);
  register_anisotropic_remeshing(module);
  register_farthest_point_sampling(module);
  register_hole_filling(module);
  register_gap_closing(module);
  register_intersection_repair(module);
  register_jet_fitting(module);
  register_mesh_check(module);
  register_moving_least_squares(module);
  register_neighbors(module);
  register_embedding(module);
  register_manifold_extraction(module);
  register_normal_orientation(module);
  register_normals(module);
  register_parallel(module);
  register_piece_sides(module);
  register_reaching(module);
  register_refinement(module);
  register_remeshing(module);
  register_restricted_voronoi(module);
  register_sheets(module);
  register_simplification(module);
  register_surface_distance(module);
  register_wnnc(module);
}
