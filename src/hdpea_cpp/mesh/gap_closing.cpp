// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/gap_closing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/boundary_loops.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/polygon_triangulation.hpp"

namespace hdpea {
namespace {

using Corners = std::array<Index, 3>;

/// All triangulations of a loop take time that grows with the cube of its edges: a second for so many.
constexpr std::size_t kMostEdges = 500;
/// Cost of an edge's squared length, where twice an area costs 1: all patches of a flat gap have one area.
constexpr double kEven = 0.01;
/// Share of a patch's area that must face as the surface does at one of its corners, and the cosine from which it does.
constexpr double kAgreeing = 0.8, kFacing = 0.3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class GapCloser {
 public:
  GapCloser(const PointsRef& vertices, const FacesRef& faces, const PointsRef& normals, double max_size)
      : vertices_(vertices), faces_(faces), normals_(normals), max_size_(max_size) {
    for (Index f = 0; f < faces.rows(); ++f) {
      for (int i = 0; i < 3; ++i) edges_.emplace(faces(f, i), faces(f, (i + 1) % 3));
    }
  }

  FilledMesh closed() {
    std::vector<Loop> open;
    FilledMesh mesh{vertices_, faces_};
    for (Loop& loop : boundary_loops(faces_, vertices_.rows(), [&](Index a, Index b) { return has_edge(a, b); })) {
      if (close(loop)) {
        ++mesh.filled;
      } else {
        open.push_back(std::move(loop));
      }
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
      for (std::size_t j = i + 1; j < open.size() && !open[i].empty(); ++j) {
        if (!close_between(open[i], open[j])) continue;
        mesh.filled += 2;
        open[i].clear();
        open[j].clear();
      }
    }
    mesh.left = std::count_if(open.begin(), open.end(), [](const Loop& loop) { return !loop.empty(); });
    mesh.faces.conservativeResize(faces_.rows() + std::ssize(added_), 3);
    for (Index f = 0; f < std::ssize(added_); ++f) {
      for (int i = 0; i < 3; ++i) mesh.faces(faces_.rows() + f, i) = added_[f][i];
    }
    return mesh;
  }

 private:
  bool has_edge(Index from, Index to) const { return edges_.contains({from, to}); }
  bool are_joined(Index a, Index b) const { return has_edge(a, b) || has_edge(b, a); }
  double distance(Index a, Index b) const { return (vertices_.row(b) - vertices_.row(a)).norm(); }
  Eigen::RowVector3d normal(const Corners& face) const {
    return area_vector(vertices_.row(face[0]), vertices_.row(face[1]), vertices_.row(face[2]));
  }

  /// The largest component of a face's normal along the surface's at its corners: at a crease it lies in the plane of
  /// one of them only.
  double along(const Corners& face, const Eigen::RowVector3d& normal_of_face) const {
    double most = -kInfinity;
    for (const Index v : face) most = std::max(most, normals_.row(v).dot(normal_of_face));
    return most;
  }

  bool close(const Loop& loop) {
    if (loop.size() > kMostEdges || is_too_large(vector_area(vertices_, loop), loop)) return false;
    const std::vector<Corners> patch = cheapest_patch(loop);
    if (patch.empty()) return false;
    double area = 0, agreeing = 0;
    for (const Corners& face : patch) {
      const Eigen::RowVector3d twice = normal(face);
      area += twice.norm() / 2;
      if (along(face, twice) >= kFacing * twice.norm()) agreeing += twice.norm() / 2;
    }
    if (is_too_large(area, loop) || agreeing < kAgreeing * area) return false;
    for (const Corners& face : patch) add(face);
    return true;
  }

  /// Closes the gap between two loops that run along each other.
  bool close_between(const Loop& a, const Loop& b) {
    if (a.empty() || b.empty() || a.size() + b.size() > kMostEdges || !runs_along(a, b) || !runs_along(b, a)) {
      return false;
    }
    std::size_t at_a = a.size(), at_b = b.size();
    double least = kInfinity;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        const auto [p, q, r, s] = ends(a, i, b, j);
        if (are_joined(p, r) || are_joined(p, s) || are_joined(q, r)) continue;
        const double from_q = distance(q, r), from_p = distance(p, s);
        if (from_q == 0 || from_p == 0) continue;  // a pinched vertex is in both loops: no face fits there
        const double length = from_q + from_p;
        if (length < least) least = length, at_a = i, at_b = j;
      }
    }
    if (least == kInfinity) return false;
    const auto [p, q, r, s] = ends(a, at_a, b, at_b);
    Loop joined;
    for (std::size_t i = 1; i <= a.size(); ++i) joined.push_back(a[(at_a + i) % a.size()]);
    for (std::size_t j = 1; j <= b.size(); ++j) joined.push_back(b[(at_b + j) % b.size()]);
    const std::array<Corners, 2> bridge{Corners{p, q, r}, {p, r, s}};
    for (const Corners& face : bridge) add(face);
    if (close(joined)) return true;
    for (const Corners& face : bridge) remove(face);
    return false;
  }

  /// Of the edge from a[i] and that from b[j].
  static std::array<Index, 4> ends(const Loop& a, std::size_t i, const Loop& b, std::size_t j) {
    return {a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]};
  }

  bool runs_along(const Loop& a, const Loop& b) const {
    return std::all_of(a.begin(), a.end(), [&](Index v) {
      return std::any_of(b.begin(), b.end(), [&](Index u) { return distance(v, u) <= max_size_; });
    });
  }

  bool is_too_large(double area, const Loop& loop) const { return 4 * area > max_size_ * perimeter(vertices_, loop); }

  std::vector<Corners> cheapest_patch(const Loop& loop) const {
    const int length = static_cast<int>(loop.size());
    Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> free(length, length);
    for (int i = 0; i < length; ++i) {
      for (int j = i + 1; j < length; ++j) {
        free(i, j) = j == i + 1 || (i == 0 && j == length - 1) || !are_joined(loop[i], loop[j]);
      }
    }
    const auto cost = [&](int i, int j, int k) {
      if (!free(i, j) || !free(j, k) || !free(i, k)) return kInfinity;
      const Corners face{loop[i], loop[j], loop[k]};
      const Eigen::RowVector3d twice = normal(face);
      const double size = twice.norm();
      if (size == 0) return kInfinity;
      double edges = 0;
      for (int e = 0; e < 3; ++e) edges += (vertices_.row(face[e]) - vertices_.row(face[(e + 1) % 3])).squaredNorm();
      return 2 * size - along(face, twice) + kEven * edges;
    };
    std::vector<Corners> patch;
    for (const auto& [i, j, k] : cheapest_triangulation(length, cost)) patch.push_back({loop[i], loop[j], loop[k]});
    return patch;
  }

  void add(const Corners& face) {
    added_.push_back(face);
    for (int i = 0; i < 3; ++i) edges_.emplace(face[i], face[(i + 1) % 3]);
  }

  void remove(const Corners& face) {
    std::erase(added_, face);
    for (int i = 0; i < 3; ++i) edges_.erase({face[i], face[(i + 1) % 3]});
  }

  const PointsRef& vertices_;
  const FacesRef& faces_;
  const PointsRef& normals_;
  double max_size_;
  std::set<std::pair<Index, Index>> edges_;  // directed
  std::vector<Corners> added_;
};

}  // namespace

FilledMesh close_gaps(const PointsRef& vertices, const FacesRef& faces, const PointsRef& normals, double max_size) {
  const MeshCheck check = check_mesh(vertices, faces);
  require(check.manifold() && check.oriented(), "closing gaps needs a manifold, oriented mesh");
  require_rows(normals, vertices.rows(), "normals");
  require_finite(normals, "normals");
  require(max_size >= 0, "the size of gaps to close must be 0 or more");
  return GapCloser(vertices, faces, normals, max_size).closed();
}

}  // namespace hdpea
