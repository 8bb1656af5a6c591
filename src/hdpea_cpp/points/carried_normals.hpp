// SPDX-License-Identifier: GPL-3.0-or-later
// Whether neighbours are on one side of the surface, and how much of it each point stands for.
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// n_i . n_j after n_i is carried along the circular arc from p_i to p_j: reflected in the plane that bisects the edge.
double carried_cosine(const PointsRef& points, const PointsRef& normals, Index i, Index j);

/// (n) area that each point stands for, to scale: that out to its farthest neighbour. Of few points far from all
/// others, which may be strays, no more than eight times the usual.
Eigen::VectorXd neighborhood_areas(const PointsRef& points, const NeighborsRef& neighbors);

}  // namespace hdpea
