// SPDX-License-Identifier: GPL-3.0-or-later
// Each concept of the core registers itself in a file of its own.
#pragma once

#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/string.h>

namespace nb = nanobind;
using namespace nb::literals;

/// Every long call of the core runs without Python's lock.
using ReleaseGil = nb::call_guard<nb::gil_scoped_release>;

void register_errors(nb::module_& module);
void register_farthest_point_sampling(nb::module_& module);
void register_hole_filling(nb::module_& module);
void register_jet_fitting(nb::module_& module);
void register_mesh_check(nb::module_& module);
void register_moving_least_squares(nb::module_& module);
void register_neighbors(nb::module_& module);
void register_embedding(nb::module_& module);
void register_manifold_extraction(nb::module_& module);
void register_normal_orientation(nb::module_& module);
void register_normals(nb::module_& module);
void register_parallel(nb::module_& module);
void register_refinement(nb::module_& module);
void register_remeshing(nb::module_& module);
void register_restricted_voronoi(nb::module_& module);
void register_sheets(nb::module_& module);
void register_simplification(nb::module_& module);
void register_surface_distance(nb::module_& module);
void register_wnnc(nb::module_& module);
