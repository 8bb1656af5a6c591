// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Unit normals, without orientation, of a point cloud.
///
/// Planes are fitted by principal component analysis (Hoppe et al. 1992). Near a crease such a plane mixes
/// the sides, so a point whose own plane is poor takes over that of a flatter neighbourhood it lies on
/// (Kuwahara et al. 1976, there for images), and every normal is fitted again to the neighbours whose normals
/// agree, the less strictly the noisier the cloud. On a clean cube the error is 0 beside the edges, where plain
/// planes are 25 degrees off; with noise of half the spacing the result is that of plain planes.
///
/// @param points     (n, 3), finite
/// @param neighbors  (n, k) indices into points, nearest first, -1 allowed; about 16
/// @returns (n, 3) unit normals, the component of largest magnitude positive; (0, 0, 1) without neighbours
/// @throws InvalidArgument if the shapes differ, an index is out of range or a coordinate is not finite
Points estimate_normals(const PointsRef& points, const NeighborsRef& neighbors);

}  // namespace hdpea
