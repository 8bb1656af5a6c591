// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/embedding/triangle_elements.hpp"

namespace hdpea {

/// Holds the mean psi of every connected piece where it was at first.
///
/// The metric does not depend on a piece's translation, and the anchor holds it weakly: without this, amplified
/// rounding errors would move it, and a shifted cloud would get another mesh.
class PinnedMeans {
 public:
  PinnedMeans(const FacesRef& triangles, const Eigen::VectorXd& areas, const Psi& psi);

  void restore(Psi& psi) const;

 private:
  /// Means by area, in the row of each piece's first vertex.
  Psi means(const Psi& psi) const;

  std::vector<Index> piece_;
  const Eigen::VectorXd& areas_;
  Eigen::VectorXd piece_areas_;  // in the row of each piece's first vertex
  Psi pinned_;
};

}  // namespace hdpea
