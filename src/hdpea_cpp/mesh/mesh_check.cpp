// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/mesh_check.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Corner 3 f + i is the i-th of face f; it also names the half-edge that starts there.
Index next_corner(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

struct HalfEdge {
  Index low, high, corner;
  bool operator<(const HalfEdge& other) const {
    return std::tie(low, high, corner) < std::tie(other.low, other.high, other.corner);
  }
  bool same_edge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

/// Counts on a list of faces without repeated indices.
class Topology {
 public:
  Topology(Index vertex_count, const std::vector<std::array<Index, 3>>& faces, MeshCheck& check)
      : vertex_count_(vertex_count), faces_(faces), check_(check), fans_(corner_count()), components_(faces.size()) {}

  void count() {
    collect_half_edges();
    for (std::size_t begin = 0, end = 0; begin < half_edges_.size(); begin = end) {
      while (end < half_edges_.size() && half_edges_[end].same_edge(half_edges_[begin])) ++end;
      add_edge(begin, end);
    }
    count_vertices();
    count_boundary_loops();
    for (std::size_t f = 0; f < faces_.size(); ++f) check_.components += components_.find(f) == static_cast<Index>(f);
  }

 private:
  Index corner_count() const { return 3 * static_cast<Index>(faces_.size()); }
  Index vertex(Index corner) const { return faces_[corner / 3][corner % 3]; }
  /// The corner at vertex v of the half-edge's face, v being one of its two ends.
  Index corner_at(Index v, const HalfEdge& edge) const {
    return vertex(edge.corner) == v ? edge.corner : next_corner(edge.corner);
  }

  void collect_half_edges() {
    half_edges_.reserve(corner_count());
    for (Index c = 0; c < corner_count(); ++c) {
      const auto [low, high] = std::minmax({vertex(c), vertex(next_corner(c))});
      half_edges_.push_back({low, high, c});
    }
    std::sort(half_edges_.begin(), half_edges_.end());
  }

  void add_edge(std::size_t begin, std::size_t end) {
    const HalfEdge& first = half_edges_[begin];
    ++check_.edges;
    for (std::size_t i = begin + 1; i < end; ++i) components_.join(first.corner / 3, half_edges_[i].corner / 3);
    if (end - begin == 1) {
      boundary_.push_back(first);
    } else if (end - begin == 2) {
      const HalfEdge& second = half_edges_[begin + 1];
      check_.inconsistent_edges += vertex(first.corner) == vertex(second.corner);
      for (Index v : {first.low, first.high}) fans_.join(corner_at(v, first), corner_at(v, second));
    } else {
      ++check_.nonmanifold_edges;
      nonmanifold_ends_.insert(nonmanifold_ends_.end(), {first.low, first.high});
    }
  }

  void count_vertices() {
    std::vector<Index> fan_count(vertex_count_, 0);
    for (Index c = 0; c < corner_count(); ++c) fan_count[vertex(c)] += fans_.find(c) == c;
    const Index used = vertex_count_ - std::count(fan_count.begin(), fan_count.end(), 0);
    check_.euler_characteristic = used - check_.edges + static_cast<Index>(faces_.size());
    for (Index v : nonmanifold_ends_) fan_count[v] = 2;
    check_.nonmanifold_vertices = std::count_if(fan_count.begin(), fan_count.end(), [](Index n) { return n > 1; });
  }

  /// An open fan joins the two boundary edges at its ends.
  void count_boundary_loops() {
    check_.boundary_edges = check_.boundary_loops = static_cast<Index>(boundary_.size());
    DisjointSets loops(check_.boundary_edges);
    std::vector<Index> edge_of_fan(corner_count(), -1);
    for (Index e = 0; e < check_.boundary_edges; ++e) {
      for (Index v : {boundary_[e].low, boundary_[e].high}) {
        Index& other = edge_of_fan[fans_.find(corner_at(v, boundary_[e]))];
        if (other < 0) {
          other = e;
        } else if (loops.join(other, e)) {
          --check_.boundary_loops;
        }
      }
    }
  }

  Index vertex_count_;
  const std::vector<std::array<Index, 3>>& faces_;
  MeshCheck& check_;
  DisjointSets fans_, components_;
  std::vector<HalfEdge> half_edges_, boundary_;
  std::vector<Index> nonmanifold_ends_;
};

Index count_duplicates(std::vector<std::array<Index, 3>> faces) {
  for (auto& face : faces) std::sort(face.begin(), face.end());
  std::sort(faces.begin(), faces.end());
  return faces.end() - std::unique(faces.begin(), faces.end());
}

}  // namespace

std::optional<Index> MeshCheck::genus() const {
  if (!manifold() || !oriented()) return std::nullopt;
  return (2 * components - boundary_loops - euler_characteristic) / 2;
}

MeshCheck check_mesh(const PointsRef& vertices, const FacesRef& faces) {
  require_mesh(vertices, faces);
  MeshCheck check;
  check.vertices = vertices.rows();
  check.faces = faces.rows();
  const auto position = [&](Index v) { return Kernel::Point_3(vertices(v, 0), vertices(v, 1), vertices(v, 2)); };
  std::vector<std::array<Index, 3>> proper;
  std::vector<char> referenced(vertices.rows(), false);
  for (const auto& face : faces.rowwise()) {
    const Index a = face(0), b = face(1), c = face(2);
    referenced[a] = referenced[b] = referenced[c] = true;
    if (a != b && b != c && c != a) proper.push_back({a, b, c});
    check.degenerate_faces += CGAL::collinear(position(a), position(b), position(c));
  }
  check.repeated_index_faces = check.faces - static_cast<Index>(proper.size());
  check.unreferenced_vertices = std::count(referenced.begin(), referenced.end(), false);
  check.duplicate_faces = count_duplicates(proper);
  Topology(check.vertices, proper, check).count();
  return check;
}

}  // namespace hdpea
