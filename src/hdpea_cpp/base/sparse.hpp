// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

namespace hdpea {

using SparseMatrix = Eigen::SparseMatrix<double>;

}  // namespace hdpea
