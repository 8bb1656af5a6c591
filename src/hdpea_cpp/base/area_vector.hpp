// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

namespace hdpea {

/// The normal of the triangle abc, as long as twice its area.
template <class A, class B, class C>
auto area_vector(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b, const Eigen::MatrixBase<C>& c) {
  return (b - a).eval().cross((c - a).eval()).eval();
}

}  // namespace hdpea
