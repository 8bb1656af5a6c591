// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/points/curvature.hpp"

namespace hdpea {

/// How many neighbours a jet is fitted to: of those given, as few as are enough for the errors below.
struct JetOptions {
  Index least_neighbors = 24;     ///< fitted first; three times as many next, and so on
  double direction_error = 0.05;  ///< radians: directions of at most this error need no more neighbours
  double curvature_error = 0;     ///< 1 / length: nor do curvatures of at most this error, as on a clean plane
};

/// Second-order shape of the surface at each point of a cloud.
struct Jets {
  Curvature curvature;              ///< signed; NaN where there are too few neighbours, or on a line or in a point
  Points normals;                   ///< (n, 3) unit, of the fitted surface, on the side of the given normals
  Eigen::VectorXd curvature_error;  ///< (n) standard error of the curvatures' difference, 1 / length; inf where NaN
  Eigen::VectorX<Index> fitted;     ///< (n) how many neighbours the jet is fitted to
};

/// Fits a quadratic height function to each point and its neighbours (Cazals and Pouget 2005, by CGAL).
///
/// Unlike estimate_curvature(), this uses positions only: the normals just tell which side is out. Convex shapes with
/// outward normals have positive curvatures.
///
/// The error is that of the mixed term of the fit, as its residuals show it. Over the difference of the curvatures
/// it is the error of the directions in radians, which grows without bound where the surface is flat or spherical.
/// With n neighbours it decreases as n^-1.5, so where there is noise, and only there, more neighbours are used.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit, consistently oriented
/// @param neighbors  (n, k) of the same sheet, nearest first, -1 pads; those that are used have equal weights
Jets fit_jets(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
              const JetOptions& options = {});

}  // namespace hdpea
