// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/hole_filling.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/boundary_loops.hpp"

namespace hdpea {
namespace {

// CGAL tries a Delaunay triangulation first, whose point location may not terminate unless predicates are exact.
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

// A hole of so few edges may fold back, unless its patch is a good part of its whole piece: then it is the border.
constexpr std::size_t kFewEdges = 8;
constexpr double kGoodPart = 0.25;
// Where a Delaunay triangulation holds no patch, CGAL tries all triangulations, in time that grows with the cube of the
// edges: a second for so many, hours for a ragged border of thousands.
constexpr std::size_t kEdgesForAllPatches = 500;
// Of so few all are tried at once: one in fifty Delaunay patches of 16 edges has a face that is turned over.
constexpr std::size_t kEdgesWithoutDelaunay = 32;
// A patch folds back where it turns by more than 135 degrees: the missing half of a thin pin turns by 120.
constexpr double kFoldedCosine = -0.7;

/// A face of a patch, by positions in the loop; the type that CGAL writes.
struct PatchFace {
  PatchFace(int i, int j, int k) : corner{i, j, k} {}
  std::array<int, 3> corner;
};

std::uint64_t directed_key(Index from, Index to) {
  return (static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint64_t>(to);
}

class HoleFiller {
 public:
  HoleFiller(const PointsRef& vertices, const FacesRef& faces)
      : vertices_(vertices),
        faces_(faces),
        pieces_(vertices.rows()),
        piece_areas_(Eigen::VectorXd::Zero(vertices.rows())) {
    opposite_.reserve(static_cast<std::size_t>(3 * faces.rows()));
    for (Index f = 0; f < faces.rows(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const bool first =
            opposite_.emplace(directed_key(faces(f, i), faces(f, (i + 1) % 3)), faces(f, (i + 2) % 3)).second;
        require(first, "fill_holes needs an edge-manifold, oriented mesh");
        pieces_.join(faces(f, i), faces(f, (i + 1) % 3));
      }
    }
    for (Index f = 0; f < faces.rows(); ++f) {
      piece_areas_(pieces_.find(faces(f, 0))) += area_vector(faces(f, 0), faces(f, 1), faces(f, 2)).norm() / 2;
    }
  }

  std::vector<Loop> loops() const {
    return boundary_loops(faces_, vertices_.rows(), [&](Index from, Index to) { return has_edge(from, to); });
  }

  /// Fills a hole of at most the size; returns whether it did.
  bool fill(const Loop& loop, double max_size) {
    const double largest = max_size * perimeter(vertices_, loop);
    // No patch is smaller than the loop's vector area, so large borders need not be triangulated at all.
    if (4 * vector_area(vertices_, loop) > largest) return false;
    const std::vector<PatchFace> patch = triangulated(loop);
    const bool fan = !fits(loop, patch), not_searched = patch.empty() && loop.size() > kEdgesForAllPatches;
    const bool too_large = 4 * (fan ? fan_area(loop) : area(loop, patch)) > largest;
    if (std::isfinite(max_size) && (not_searched || too_large || folds_back(loop, patch))) return false;
    if (fan) {
      add_fan(loop);
    } else {
      for (const PatchFace& face : patch) add(loop[face.corner[0]], loop[face.corner[1]], loop[face.corner[2]]);
    }
    return true;
  }

  FilledMesh result() const {
    FilledMesh mesh{Points(vertices_.rows() + static_cast<Index>(centres_.size()), 3),
                    Faces(faces_.rows() + static_cast<Index>(added_.size()), 3)};
    mesh.vertices.topRows(vertices_.rows()) = vertices_;
    for (std::size_t i = 0; i < centres_.size(); ++i)
      mesh.vertices.row(vertices_.rows() + static_cast<Index>(i)) = centres_[i];
    mesh.faces.topRows(faces_.rows()) = faces_;
    for (std::size_t i = 0; i < added_.size(); ++i) mesh.faces.row(faces_.rows() + static_cast<Index>(i)) = added_[i];
    return mesh;
  }

 private:
  bool has_edge(Index from, Index to) const { return opposite_.count(directed_key(from, to)) > 0; }

  double area(const Loop& loop, const std::vector<PatchFace>& patch) const {
    double twice = 0;
    for (const PatchFace& face : patch) {
      twice += area_vector(loop[face.corner[0]], loop[face.corner[1]], loop[face.corner[2]]).norm();
    }
    return twice / 2;
  }

  /// Whether the patch mostly lies on the faces around it, facing the other way.
  bool folds_back(const Loop& loop, const std::vector<PatchFace>& patch) {
    const double piece_area = piece_areas_(pieces_.find(loop[0]));
    if (loop.size() <= kFewEdges && area(loop, patch) < kGoodPart * piece_area) return false;
    double sum = 0;
    for (const PatchFace& face : patch) {
      for (int i = 0; i < 3; ++i) {
        const int from = face.corner[i], to = face.corner[(i + 1) % 3];
        if ((from + 1) % static_cast<int>(loop.size()) != to) continue;
        const Index a = loop[from], b = loop[to];
        const Eigen::RowVector3d inside = area_vector(a, b, loop[face.corner[(i + 2) % 3]]).stableNormalized();
        const Eigen::RowVector3d outside = area_vector(b, a, opposite_.at(directed_key(b, a))).stableNormalized();
        sum += inside.dot(outside);
      }
    }
    return sum < kFoldedCosine * static_cast<double>(loop.size());
  }

  Eigen::RowVector3d area_vector(Index a, Index b, Index c) const {
    return hdpea::area_vector(vertices_.row(a), vertices_.row(b), vertices_.row(c));
  }

  std::vector<PatchFace> triangulated(const Loop& loop) const {
    const auto point = [&](Index v) { return Point(vertices_(v, 0), vertices_(v, 1), vertices_(v, 2)); };
    std::vector<Point> polyline, beyond;  // the loop, and the corners opposite to its edges
    for (std::size_t i = 0; i < loop.size(); ++i) {
      polyline.push_back(point(loop[i]));
      beyond.push_back(point(opposite_.at(directed_key(loop[(i + 1) % loop.size()], loop[i]))));
    }
    // Closed here: CGAL would take a loop whose first and last vertex lie in one place for closed already.
    polyline.push_back(polyline.front());
    beyond.push_back(beyond.front());
    std::vector<PatchFace> patch;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        polyline, beyond, std::back_inserter(patch),
        CGAL::parameters::use_delaunay_triangulation(loop.size() > kEdgesWithoutDelaunay)
            .do_not_use_cubic_algorithm(loop.size() > kEdgesForAllPatches));
    orient(patch);
    return patch;
  }

  /// Makes the patch run along the loop: its face at the edge (0, 1) goes from 0 to 1.
  static void orient(std::vector<PatchFace>& patch) {
    for (const PatchFace& face : patch) {
      for (int i = 0; i < 3; ++i) {
        if (face.corner[i] == 0 && face.corner[(i + 1) % 3] == 1) return;
      }
    }
    for (PatchFace& face : patch) std::swap(face.corner[1], face.corner[2]);
  }

  /// Whether a patch covers the loop, and none of its faces and inner edges is one of the mesh's.
  bool fits(const Loop& loop, const std::vector<PatchFace>& patch) const {
    const int length = static_cast<int>(loop.size());
    if (static_cast<int>(patch.size()) + 2 != length) return false;
    for (const PatchFace& face : patch) {
      for (int i = 0; i < 3; ++i) {
        const int from = face.corner[i], to = face.corner[(i + 1) % 3];
        const bool on_loop = (from + 1) % length == to;
        const Index third = loop[face.corner[(i + 2) % 3]];
        if (on_loop && opposite_.at(directed_key(loop[to], loop[from])) == third) return false;
        if (!on_loop && (has_edge(loop[from], loop[to]) || has_edge(loop[to], loop[from]))) return false;
      }
    }
    return true;
  }

  Eigen::RowVector3d centre_of(const Loop& loop) const {
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
    for (Index v : loop) centre += vertices_.row(v) / static_cast<double>(loop.size());
    return centre;
  }

  double fan_area(const Loop& loop) const {
    const Eigen::RowVector3d centre = centre_of(loop);
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      twice += hdpea::area_vector(centre, vertices_.row(loop[i]), vertices_.row(loop[(i + 1) % loop.size()])).norm();
    }
    return twice / 2;
  }

  void add_fan(const Loop& loop) {
    const Index middle = vertices_.rows() + static_cast<Index>(centres_.size());
    centres_.push_back(centre_of(loop));
    for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()], middle);
  }

  void add(Index a, Index b, Index c) {
    added_.emplace_back(a, b, c);
    opposite_.emplace(directed_key(a, b), c);
    opposite_.emplace(directed_key(b, c), a);
    opposite_.emplace(directed_key(c, a), b);
  }

  const PointsRef& vertices_;
  const FacesRef& faces_;
  DisjointSets pieces_;                                // of vertices
  Eigen::VectorXd piece_areas_;                        // by the piece's name
  std::unordered_map<std::uint64_t, Index> opposite_;  // of each directed edge: its face's third corner; only looked up
  std::vector<Eigen::RowVector<Index, 3>> added_;
  std::vector<Eigen::RowVector3d> centres_;
};

}  // namespace

FilledMesh fill_holes(const PointsRef& vertices, const FacesRef& faces, double max_size, const Progress& progress) {
  require_mesh(vertices, faces);
  require(max_size >= 0, "the size of holes to fill must be 0 or more");
  HoleFiller filler(vertices, faces);
  const std::vector<Loop> loops = filler.loops();
  Index filled = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    report(progress, static_cast<double>(i) / static_cast<double>(loops.size()));
    if (max_size > 0 && filler.fill(loops[i], max_size)) ++filled;
  }
  FilledMesh mesh = filler.result();
  mesh.filled = filled;
  mesh.left = static_cast<Index>(loops.size()) - filled;
  report(progress, 1);
  return mesh;
}

}  // namespace hdpea
