// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/embedding/pinned_means.hpp"

#include "hdpea_cpp/base/disjoint_sets.hpp"

namespace hdpea {

PinnedMeans::PinnedMeans(const FacesRef& triangles, const Eigen::VectorXd& areas, const Psi& psi)
    : piece_(static_cast<std::size_t>(psi.rows())), areas_(areas) {
  DisjointSets sets(psi.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    sets.join(triangles(t, 0), triangles(t, 1));
    sets.join(triangles(t, 0), triangles(t, 2));
  }
  piece_areas_ = Eigen::VectorXd::Zero(psi.rows());
  for (Index v = 0; v < psi.rows(); ++v) {
    piece_[v] = sets.find(v);
    piece_areas_(piece_[v]) += areas(v);
  }
  pinned_ = means(psi);
}

void PinnedMeans::restore(Psi& psi) const {
  const Psi shifts = pinned_ - means(psi);
  for (Index v = 0; v < psi.rows(); ++v) psi.row(v) += shifts.row(piece_[v]);
}

Psi PinnedMeans::means(const Psi& psi) const {
  Psi sums = Psi::Zero(psi.rows(), 5);
  for (Index v = 0; v < psi.rows(); ++v) sums.row(piece_[v]) += areas_(v) * psi.row(v);
  return piece_areas_.cwiseMax(1e-300).cwiseInverse().asDiagonal() * sums;
}

}  // namespace hdpea
