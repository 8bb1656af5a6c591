// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/cholesky.hpp"

#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {

Cholesky::Cholesky(const SparseMatrix& matrix) : factorization_(matrix), permuted_(matrix.rows(), 5) {
  if (factorization_.info() != Eigen::Success) {
    throw CannotReconstruct(
        "the sparse system is not positive definite: a length is out of proportion to the spacing of the points");
  }
}

void Cholesky::solve_in_place(Columns& columns) const {
  const SparseMatrix& lower = factorization_.matrixL().nestedExpression();
  const int* starts = lower.outerIndexPtr();
  const int* rows = lower.innerIndexPtr();
  const double* values = lower.valuePtr();
  permuted_.noalias() = factorization_.permutationP() * columns;
  // Each column of L starts with its diagonal entry.
  for (Index j = 0; j < lower.cols(); ++j) {
    permuted_.row(j) /= values[starts[j]];
    const Eigen::Matrix<double, 1, 5> pivot = permuted_.row(j);
    for (int at = starts[j] + 1; at < starts[j + 1]; ++at) permuted_.row(rows[at]) -= values[at] * pivot;
  }
  for (Index j = lower.cols() - 1; j >= 0; --j) {
    Eigen::Matrix<double, 1, 5> sum = permuted_.row(j);
    for (int at = starts[j] + 1; at < starts[j + 1]; ++at) sum -= values[at] * permuted_.row(rows[at]);
    permuted_.row(j) = sum / values[starts[j]];
  }
  columns.noalias() = factorization_.permutationPinv() * permuted_;
}

}  // namespace hdpea
