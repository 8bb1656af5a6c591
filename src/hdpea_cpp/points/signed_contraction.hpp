// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/signed_sets.hpp"
#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// How strongly two things should have equal signs, or opposite ones if it is negative.
struct SignedEdge {
  Index i, j;
  double weight;
};

/// Joins the ends of edges, those first between whose sets the sum of all weights is largest, with the signs of that
/// sum.
///
/// Greedy additive edge contraction (Keuper et al., "Efficient decomposition of image and mesh graphs by lifted
/// multicuts", 2015). Where edges contradict each other, many outweigh few, as they do not in a spanning tree.
void join_by_weight(SignedSets& sets, const std::vector<SignedEdge>& edges);

}  // namespace hdpea
