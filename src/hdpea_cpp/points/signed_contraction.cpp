// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/signed_contraction.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace hdpea {
namespace {

/// A graph whose nodes, named by one member each, become fewer.
class Contraction {
 public:
  Contraction(SignedSets& sets, const std::vector<SignedEdge>& edges) : sets_(sets) {
    for (const auto& [i, j, weight] : edges) {
      const auto [a, a_flipped] = sets_.find(i);
      const auto [b, b_flipped] = sets_.find(j);
      if (a != b) add(a, b, a_flipped == b_flipped ? weight : -weight);
    }
    for (const auto& [a, beside] : beside_) {
      for (const auto& [b, weight] : beside) {
        if (a < b) offer(a, b, weight);
      }
    }
  }

  void run() {
    while (!waiting_.empty()) {
      const Offer best = waiting_.top();
      waiting_.pop();
      if (is_current(best)) contract(best.a, best.b);
    }
  }

 private:
  struct Offer {
    double weight;
    Index a, b;
    /// The largest first; names break ties.
    bool operator<(const Offer& other) const {
      return std::tuple(std::abs(weight), other.a, other.b) < std::tuple(std::abs(other.weight), a, b);
    }
  };
  using Weights = std::unordered_map<Index, double>;

  void add(Index a, Index b, double weight) {
    beside_[a][b] += weight;
    beside_[b][a] += weight;
  }
  void offer(Index a, Index b, double weight) { waiting_.push({weight, std::min(a, b), std::max(a, b)}); }
  bool is_current(const Offer& offer) const {
    const auto node = beside_.find(offer.a);
    if (node == beside_.end()) return false;
    const auto weight = node->second.find(offer.b);
    return weight != node->second.end() && weight->second == offer.weight;
  }

  /// Joins two nodes, and keeps the name of that with more neighbours.
  void contract(Index a, Index b) {
    if (std::tuple(beside_[a].size(), b) < std::tuple(beside_[b].size(), a)) std::swap(a, b);
    const bool opposite = beside_[a][b] < 0;
    sets_.join(a, b, opposite);
    const Weights moved = std::move(beside_[b]);
    beside_.erase(b);
    for (const auto& [c, weight] : moved) {
      beside_[c].erase(b);
      if (c == a) continue;
      add(a, c, opposite ? -weight : weight);
      offer(a, c, beside_[a][c]);
    }
  }

  SignedSets& sets_;
  std::unordered_map<Index, Weights> beside_;
  std::priority_queue<Offer> waiting_;
};

}  // namespace

void join_by_weight(SignedSets& sets, const std::vector<SignedEdge>& edges) { Contraction(sets, edges).run(); }

}  // namespace hdpea
