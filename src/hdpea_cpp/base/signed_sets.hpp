// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Union-find over 0 .. n-1 that also knows whether two members of a set have equal or opposite signs.
///
/// Joining two sets flips one of them as a whole, at no cost: so orientations can be agreed on piece by piece.
class SignedSets {
 public:
  explicit SignedSets(Index n = 0)
      : parent_(static_cast<std::size_t>(n)), flipped_(parent_.size(), 0), size_(parent_.size(), 1) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  /// Adds one member, a set of its own.
  void add() {
    parent_.push_back(static_cast<Index>(parent_.size()));
    flipped_.push_back(0);
    size_.push_back(1);
  }

  /// The set's representative, and whether the member's sign is opposite to its.
  std::pair<Index, bool> find(Index i) {
    Index root = i;
    bool flipped = false;
    for (; parent_[root] != root; root = parent_[root]) flipped = flipped != (flipped_[root] != 0);
    // Path compression: every member on the way now hangs directly on the root.
    bool remaining = flipped;
    while (parent_[i] != root && i != root) {
      const Index next = parent_[i];
      const bool step = flipped_[i] != 0;
      parent_[i] = root;
      flipped_[i] = remaining;
      remaining = remaining != step;
      i = next;
    }
    return {root, flipped};
  }

  /// How many members the set of i has.
  Index size(Index i) { return size_[find(i).first]; }

  /// Joins the sets of i and j such that the two have opposite signs, or equal ones; the representative of i's
  /// set stays. Members of one set keep the signs they have.
  void join(Index i, Index j, bool opposite) {
    const auto [root_i, flipped_i] = find(i);
    const auto [root_j, flipped_j] = find(j);
    if (root_i == root_j) return;
    parent_[root_j] = root_i;
    size_[root_i] += size_[root_j];
    flipped_[root_j] = (flipped_i != flipped_j) != opposite;
  }

 private:
  std::vector<Index> parent_;
  std::vector<char> flipped_;  // against the parent
  std::vector<Index> size_;    // of representatives
};

}  // namespace hdpea
