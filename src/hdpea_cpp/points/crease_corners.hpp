// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of creases end in corners.
#pragma once

#include <vector>

#include "hdpea_cpp/points/creases.hpp"

namespace hdpea {

/// Finds the corners where lines of different directions end, and adds samples from each end to its corner.
///
/// Where lines meet is moved to where the planes around it do: the lines of curved creases are tangents, which meet
/// outside the surface.
///
/// @param points   (n, 3), n >= 1
/// @param normals  (n, 3) unit
std::vector<Eigen::Vector3d> join_at_corners(std::vector<CreaseSample>& samples, const PointsRef& points,
                                             const PointsRef& normals);

}  // namespace hdpea
