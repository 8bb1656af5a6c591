// SPDX-License-Identifier: GPL-3.0-or-later
// Each concept of the core registers itself in a file of its own.
#pragma once

#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/string.h>

#include "hdpea_cpp/base/types.hpp"

namespace nanobind::detail {

/// A progress callback of Python: None goes on, as a function without a return statement gives it, and whatever else it
/// returns counts by its truth. nanobind's own caster takes nothing but True and False.
template <>
struct type_caster<hdpea::Progress> {
  NB_TYPE_CASTER(hdpea::Progress, const_name("collections.abc.Callable[[float], object]"))

  struct Callback : pyfunc_wrapper {
    using pyfunc_wrapper::pyfunc_wrapper;
    bool operator()(double fraction) const {
      gil_scoped_acquire acquired;
      const object answer = handle(f)(fraction);
      const int truth = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
      if (truth < 0) raise_python_error();
      return truth != 0;
    }
  };

  bool from_python(handle source, uint32_t flags, cleanup_list*) noexcept {
    if (source.is_none()) return flags & cast_flags::convert;
    if (!PyCallable_Check(source.ptr())) return false;
    value = Callback(source.ptr());
    return true;
  }

  static handle from_cpp(const hdpea::Progress&, rv_policy, cleanup_list*) noexcept { return none().release(); }
};

}  // namespace nanobind::detail

namespace nb = nanobind;
using namespace nb::literals;

/// Every long call of the core runs without Python's lock.
using ReleaseGil = nb::call_guard<nb::gil_scoped_release>;

void register_creases(nb::module_& module);
void register_crease_alignment(nb::module_& module);
void register_anisotropic_remeshing(nb::module_& module);
void register_errors(nb::module_& module);
void register_farthest_point_sampling(nb::module_& module);
void register_gap_closing(nb::module_& module);
void register_hole_filling(nb::module_& module);
void register_intersection_repair(nb::module_& module);
void register_jet_fitting(nb::module_& module);
void register_mesh_check(nb::module_& module);
void register_moving_least_squares(nb::module_& module);
void register_neighbors(nb::module_& module);
void register_embedding(nb::module_& module);
void register_manifold_extraction(nb::module_& module);
void register_normal_orientation(nb::module_& module);
void register_normals(nb::module_& module);
void register_parallel(nb::module_& module);
void register_piece_sides(nb::module_& module);
void register_reaching(nb::module_& module);
void register_refinement(nb::module_& module);
void register_remeshing(nb::module_& module);
void register_restricted_voronoi(nb::module_& module);
void register_sheets(nb::module_& module);
void register_simplification(nb::module_& module);
void register_surface_distance(nb::module_& module);
void register_wnnc(nb::module_& module);
