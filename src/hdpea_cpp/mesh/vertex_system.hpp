// SPDX-License-Identifier: GPL-3.0-or-later
// The linear system of a fit: a 3 x 3 block for each vertex of a mesh, and for each two that share a face.
#pragma once

#include <array>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A symmetric positive definite matrix over the coordinates of the vertices of a mesh, summed face by face.
///
/// It is solved by conjugate gradients (Hestenes and Stiefel 1952), preconditioned by the blocks of the vertices.
/// Neighbours are coupled by mass, not stiffness, so that some tens of iterations do, however many vertices there
/// are: a factorization fills up, and takes time that grows faster than they do.
class VertexSystem {
 public:
  /// Zero. @param faces  (f, 3), in [0, vertices); refers to it from then on
  VertexSystem(Index vertices, const FacesRef& faces);

  /// Adds weight_i weight_j direction direction^T for each two corners i, j of a face.
  void add(Index face, const Eigen::RowVector3d& weights, const Eigen::RowVector3d& direction);
  /// Adds a number to the diagonal.
  void add_to_diagonal(double value);
  /// Solves for the vertices (v, 3), beginning at `start`, and stops as near to the solution as rounding allows.
  ///
  /// @param fixed  (v), or none: which vertices stay at `start`, so that the others are solved for alone
  /// @throws CannotReconstruct if numbers overflow
  Points solve(const Points& right, const Points& start, const MaskRef& fixed = Mask()) const;

 private:
  using Block = Eigen::Matrix3d;

  Points times(const Points& vectors) const;

  std::vector<Index> starts_;                 // (v + 1) of the row of each vertex
  std::vector<Index> columns_;                // vertices, in each row itself first
  std::vector<Block> blocks_;                 // one for each column
  std::vector<std::array<Index, 9>> places_;  // (f) of the blocks of two corners each
};

}  // namespace hdpea
