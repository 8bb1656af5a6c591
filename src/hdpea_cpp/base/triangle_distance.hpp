// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace hdpea {

/// Squared distance of p from the triangle abc (Ericson, Real-Time Collision Detection, section 5.1.5).
double squared_distance_from_triangle(const Eigen::RowVector3d& p, const Eigen::RowVector3d& a,
                                      const Eigen::RowVector3d& b, const Eigen::RowVector3d& c);

}  // namespace hdpea
