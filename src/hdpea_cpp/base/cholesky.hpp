// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>

#include "hdpea_cpp/base/sparse.hpp"
#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A sparse Cholesky factorisation P A P^T = L L^T with a fill-reducing order, made once and solved often.
///
/// Eigen solves several right-hand sides one after the other and reads L anew for each; here a row of the
/// right-hand side is one short vector, so L is read once. That is several times faster for the five
/// columns of an embedding.
class Cholesky {
 public:
  /// @throws CannotReconstruct if the matrix is not positive definite
  explicit Cholesky(const SparseMatrix& matrix);

  /// Solves A X = B in place, for B of shape (n, 5).
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;
  void solve_in_place(Columns& columns) const;

 private:
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> factorization_;
  mutable Columns permuted_;
};

}  // namespace hdpea
