// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "hdpea_cpp/base/types.hpp"
#include "hdpea_cpp/points/curvature.hpp"

namespace hdpea {

/// How the embedding psi : surface -> R^5 is solved for. Lengths are in the unit of the points.
struct EmbeddingOptions {
  double metric_scale = 0.5;      ///< c of the metric s_i^2 = clamp(c |k_i|, 1, max_stretch^2), a length
  double max_stretch = 8.0;       ///< largest stretch s in any direction, >= 1
  double bending_length = 0.008;  ///< psi does not bend below this length, >= 0; 0 crumples
  Index iterations = 25;          ///< local/global rounds
};

/// Solves for psi with J_psi^T J_psi = M - I, so that x -> [x, psi(x)] in R^8 is isometric under M.
///
/// M = R diag(s1^2, s2^2) R^T in the tangent plane, from the principal curvatures. Minimises
///     sum_t area_t |J_t - R_t Q_t|^2 + l^2 |A^(-1/2) L psi|^2,   Q = sqrt(M - I),
/// over psi and orthonormal frames R_t (5 x 2) by local/global iteration (Liu et al. 2008). The second term
/// is bending: a smooth isometric embedding need not exist, and without it psi crumples and the tangent
/// disks of neighbours disagree.
///
/// The global step's matrix is L + l^2 L A^-1 L = (A + l^2 L) A^-1 L, with L the cotangent Laplacian and A
/// the lumped areas: two second-order systems, whose Cholesky factors are several times sparser than that
/// of the product. By partial fractions its inverse is L^-1 - l^2 (A + l^2 L)^-1, so that neither solve
/// waits for the other.
///
/// @param points     (n, 3)
/// @param normals    (n, 3) unit, consistently oriented; psi starts at 0.2 n, which separates the two sides of a wall
/// @param curvature  as from estimate_curvature() (n)
/// @param triangles  (t, 3) a mesh, or a soup that covers the surface
/// @param weights    (t) 1 for a mesh; for a soup the share of each triangle, so that areas are counted once
/// @param initial    (n, 5) psi to begin at, in any gauge, instead of 0.2 n: the nearer to a solution, the fewer
///                   iterations are needed
/// @returns (n, 5)
/// @throws InvalidArgument on a broken contract; CannotReconstruct if the points lie in one place or lengths
///         are out of all proportion to them; Cancelled
Coordinates solve_embedding(const PointsRef& points, const PointsRef& normals, const Curvature& curvature,
                            const FacesRef& triangles, const Eigen::Ref<const Eigen::VectorXd>& weights,
                            const EmbeddingOptions& options, const Progress& progress = {},
                            const std::optional<Coordinates>& initial = {});

}  // namespace hdpea
