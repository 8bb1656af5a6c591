// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/anisotropic_remeshing.hpp"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/mesh/cgal_mesh.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/point_guard.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

using Vertex = SurfaceMesh::Vertex_index;
using Halfedge = SurfaceMesh::Halfedge_index;
using Edge = SurfaceMesh::Edge_index;
using Vector = Eigen::RowVector3d;

/// Passes over all edges in a round, unless none is left to flip.
constexpr int kPasses = 3;

/// Radians by which two opposite angles may be short of 180 degrees, or beyond, for the sake of the valences: half of
/// it leaves a third more irregular vertices, twice of it gains nothing.
constexpr double kSlack = 0.8;

/// A flip for the Delaunay condition must be worth it, lest rounding decides.
constexpr double kLeastExcess = 1e-3;

/// Least cosine between the two faces of a flipped edge, unless it was less before.
constexpr double kUnfolded = 0.3;

/// Shares of a step that are tried, each half of the one before, until one does no harm.
constexpr int kShares = 3;

double angle_between(const Coordinate& u, const Coordinate& v) {
  const double lengths = std::sqrt(u.squaredNorm() * v.squaredNorm());
  return lengths > 0 ? std::acos(std::clamp(u.dot(v) / lengths, -1.0, 1.0)) : 0;
}

/// How far from the points a vertex may move, in spacings of these and of the vertices, unless it was farther: beyond a
/// crease that few points show, the plane of one side goes on into the air. With 0.7 HDs are no lower, and G is lower
/// by 0.007.
constexpr double kGap = 1, kGapOfVertices = 0.25;

/// A point faces against those around it whose normal has less than this cosine with their sum.
constexpr double kBothWays = -0.5;

enum class Aim { kValence, kDelaunay };

class Remesher {
 public:
  Remesher(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
           const EmbeddedCloud& cloud, const AnisotropicRemeshingOptions& options, const MaskRef& fixed)
      : cloud_(cloud),
        options_(options),
        mesh_(to_cgal(vertices, faces)),
        positions_(vertices),
        coordinates_(coordinates),
        cells_(cloud, coordinates_, vertices, faces),
        guard_(mesh_, positions_, cells_, cloud),
        moves_(static_cast<std::size_t>(vertices.rows())) {
    require(static_cast<Index>(mesh_.number_of_vertices()) == vertices.rows(), "a vertex lies on no face");
    for (const Vertex v : mesh_.vertices()) {
      const bool stays = fixed.size() > 0 && fixed(v.idx());
      moves_[v.idx()] = !stays && !mesh_.is_isolated(v) && !mesh_.is_border(v);
    }
    const Neighbors nearest = nearest_neighbors(cloud.coordinates, coordinates, 1);
    for (Index v = 0; v < vertices.rows(); ++v) {
      coordinates_.row(v) = cloud.projected(coordinates.row(v), nearest(v, 0));
    }
    update_cells();
  }

  void flip(Aim aim) {
    for (int pass = 0; pass < kPasses; ++pass) {
      bool flipped = false;
      for (const Edge e : mesh_.edges()) {
        const Halfedge h = mesh_.halfedge(e);
        if (mesh_.is_border(e)) continue;
        if (is_worth(h, aim) && is_possible(h) && flip_harmlessly(h)) flipped = true;
      }
      if (!flipped) return;
    }
  }

  void relax() {
    Coordinates targets = coordinates_;
    Points places = positions_;
    parallel_for(positions_.rows(), [&](Index v) {
      if (moves_[v]) find_target(Vertex(static_cast<SurfaceMesh::size_type>(v)), targets.row(v), places.row(v));
    });
    for (const Vertex v : mesh_.vertices()) {
      if (moves_[v.idx()]) move(v, targets.row(v.idx()), places.row(v.idx()));
    }
    update_cells();
  }

  EmbeddedMesh result() const {
    Faces faces(mesh_.number_of_faces(), 3);
    for (const auto f : mesh_.faces()) {
      int corner = 0;
      for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) faces(f.idx(), corner++) = v.idx();
    }
    return {positions_, coordinates_, std::move(faces)};
  }

 private:
  void update_cells() {
    cells_.update(
        coordinates_,
        [&](Index v, const std::function<void(Index)>& visit) {
          const Vertex vertex(static_cast<SurfaceMesh::size_type>(v));
          if (mesh_.is_isolated(vertex)) return;
          for (const Vertex u : mesh_.vertices_around_target(mesh_.halfedge(vertex))) visit(u.idx());
        },
        [&](Index point, Index v) { return guard_.may_cover(point, Vertex(static_cast<SurfaceMesh::size_type>(v))); });
  }

  // ---- flips

  /// The corners of the faces abc and bad of the edge ab.
  struct Quadrilateral {
    Vertex a, b, c, d;
  };

  Quadrilateral around(Halfedge h) const {
    const Halfedge o = mesh_.opposite(h);
    return {mesh_.source(h), mesh_.target(h), mesh_.target(mesh_.next(h)), mesh_.target(mesh_.next(o))};
  }

  bool is_worth(Halfedge h, Aim aim) const {
    const auto [a, b, c, d] = around(h);
    const double excess = angle(a, c, b) + angle(a, d, b) - std::numbers::pi;
    if (aim == Aim::kDelaunay) return excess > kLeastExcess;
    const double gain = irregularity(a, 0) + irregularity(b, 0) + irregularity(c, 0) + irregularity(d, 0) -
                        irregularity(a, -1) - irregularity(b, -1) - irregularity(c, 1) - irregularity(d, 1);
    return excess > (gain > 0 ? -kSlack : kSlack);
  }

  bool is_possible(Halfedge h) const {
    const auto [a, b, c, d] = around(h);
    if (c == d || mesh_.halfedge(c, d).is_valid() || mesh_.degree(a) <= 3 || mesh_.degree(b) <= 3) return false;
    const double before = std::min(guard_.uprightness(a, b, c), guard_.uprightness(b, a, d));
    const double after = std::min(guard_.uprightness(a, d, c), guard_.uprightness(d, b, c));
    if (!PointGuard::stays_upright(after, before)) return false;
    const double unfolded = guard_.unit_normal(a, b, c).dot(guard_.unit_normal(b, a, d));
    return guard_.unit_normal(a, d, c).dot(guard_.unit_normal(d, b, c)) >= std::min(kUnfolded, unfolded);
  }

  /// Flips an edge, and back if that takes the points around it too far from the faces; whether it stays flipped.
  bool flip_harmlessly(Halfedge h) {
    const auto [a, b, c, d] = around(h);
    const std::array corners{a, b, c, d};
    const PointGuard::SquaredDistances most = guard_.allowed(corners);
    CGAL::Euler::flip_edge(h, mesh_);
    if (guard_.squared_distances(corners).within(most)) return true;
    CGAL::Euler::flip_edge(h, mesh_);
    return false;
  }

  double irregularity(Vertex v, int change) const {
    const int regular = mesh_.is_border(v) ? 4 : 6;
    return std::pow(static_cast<int>(mesh_.degree(v)) + change - regular, 2);
  }

  /// The angle at b in R^d.
  double angle(Vertex a, Vertex b, Vertex c) const {
    return angle_between(coordinates_.row(a.idx()) - coordinates_.row(b.idx()),
                         coordinates_.row(c.idx()) - coordinates_.row(b.idx()));
  }

  // ---- relaxation

  template <class Target, class Place>
  void find_target(Vertex v, Target&& target, Place&& place) const {
    const Coordinate here = coordinates_.row(v.idx());
    const Coordinate middle = here + options_.step * (ring_centroid(v) - here);
    const Index nearest = nearest_point(v, middle);
    if (nearest < 0) return;
    const Coordinate foot = cloud_.projected(middle, nearest);
    target = foot;
    place = cells_.planes(v.idx()).least(foot.head<3>(), options_.pull);
  }

  /// Goes as far towards a place as does no harm.
  void move(Vertex v, const Coordinate& target, const Vector& place) {
    const Index i = v.idx();
    const Vector from = positions_.row(i);
    const double before = guard_.uprightness(v);
    const std::array moved{v};
    const PointGuard::SquaredDistances most = guard_.allowed(moved);
    const double farthest = std::max(squared_gap(v), squared_clearance(v, from));
    double share = 1;
    for (int tried = 0; tried < kShares; ++tried, share /= 2) {
      positions_.row(i) = from + share * (place - from);
      if (PointGuard::stays_upright(guard_.uprightness(v), before) &&
          squared_clearance(v, positions_.row(i)) <= farthest && guard_.squared_distances(moved).within(most)) {
        coordinates_.row(i) += share * (target - coordinates_.row(i));
        return;
      }
    }
    positions_.row(i) = from;
  }

  /// How far in R^3 a place for a vertex is from the points around it.
  double squared_clearance(Vertex v, const Vector& place) const {
    double least = std::numeric_limits<double>::infinity();
    visit_points_around(v,
                        [&](Index point) { least = std::min(least, (place - cloud_.position(point)).squaredNorm()); });
    return least;
  }

  /// The farthest that a vertex may move from the points around it, by their spacing and that of the vertices. Where
  /// the surface ends, or points face both ways, any distance will do.
  double squared_gap(Vertex v) const {
    double area = 0, vertices = 0, points = 0;
    Vector normals = Vector::Zero();
    bool ends = false;
    const auto look = [&](Vertex u) {
      for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(u))) {
        if (!mesh_.is_border(h)) area += guard_.area(mesh_.face(h)) / 3;
      }
      ends |= mesh_.is_border(u);
      vertices += 1;
      normals += cells_.planes(u.idx()).normals;
      points += cells_.planes(u.idx()).count;
    };
    look(v);
    for (const Vertex u : mesh_.vertices_around_target(mesh_.halfedge(v))) look(u);
    const double least = kBothWays * normals.norm();
    visit_points_around(v, [&](Index point) { ends |= cloud_.normals.row(point).dot(normals) < least; });
    if (ends) return std::numeric_limits<double>::infinity();
    return area * std::max(kGap * kGap / std::max(points, 1.0), kGapOfVertices * kGapOfVertices / vertices);
  }

  /// Of the faces around a vertex, in R^d, by area.
  Coordinate ring_centroid(Vertex v) const {
    const Coordinate here = coordinates_.row(v.idx());
    Coordinate sum = Coordinate::Zero(here.size());
    double total = 0;
    for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      const Coordinate s = coordinates_.row(mesh_.source(h).idx()) - here,
                       t = coordinates_.row(mesh_.target(mesh_.next(h)).idx()) - here;
      const double area = std::sqrt(std::max(0.0, s.squaredNorm() * t.squaredNorm() - std::pow(s.dot(t), 2)));
      sum += area * (s + t) / 3;
      total += area;
    }
    return total > 0 ? Coordinate(here + sum / total) : here;
  }

  /// Of the points of a vertex and its neighbours, the nearest in R^d; -1 if these have none.
  Index nearest_point(Vertex v, const Coordinate& x) const {
    Index best = -1;
    double least = std::numeric_limits<double>::infinity();
    visit_points_around(v, [&](Index point) {
      const double distance = (x - cloud_.coordinates.row(point)).squaredNorm();
      if (distance < least) least = distance, best = point;
    });
    return best;
  }

  template <class Visit>
  void visit_points_around(Vertex v, const Visit& visit) const {
    for (const Index point : cells_.points(v.idx())) visit(point);
    for (const Vertex u : mesh_.vertices_around_target(mesh_.halfedge(v))) {
      for (const Index point : cells_.points(u.idx())) visit(point);
    }
  }

  const EmbeddedCloud& cloud_;
  const AnisotropicRemeshingOptions& options_;
  SurfaceMesh mesh_;
  Points positions_;         // in R^3
  Coordinates coordinates_;  // in R^d
  VertexCells cells_;
  PointGuard guard_;
  std::vector<char> moves_;  // of each vertex
};

}  // namespace

EmbeddedMesh remesh_anisotropically(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                                    const EmbeddedCloud& cloud, const AnisotropicRemeshingOptions& options,
                                    const Progress& progress, const MaskRef& fixed) {
  require_embedded(cloud);
  require_rows(coordinates, vertices.rows(), "coordinates");
  require(coordinates.cols() == cloud.coordinates.cols(), "vertices and points must lie in the same dimension");
  require_finite(coordinates, "coordinates", kLargestToTheFourth);
  require_finite(vertices, "vertices", kLargestToTheFourth);
  if (fixed.size() > 0) require_rows(fixed, vertices.rows(), "fixed");
  require(faces.rows() >= 1, "remeshing needs at least one face");
  require(options.rounds >= 0 && options.step >= 0 && options.pull > 0,
          "rounds and step must be 0 or more, pull positive");
  const MeshCheck check = check_mesh(vertices, faces);
  require(check.manifold() && check.oriented(), "remeshing needs a manifold, oriented mesh");
  Remesher remesher(vertices, coordinates, faces, cloud, options, fixed);
  for (Index round = 0; round < options.rounds; ++round) {
    report(progress, static_cast<double>(round) / static_cast<double>(options.rounds));
    remesher.flip(round < options.valence_rounds ? Aim::kValence : Aim::kDelaunay);
    remesher.relax();
  }
  remesher.flip(Aim::kDelaunay);
  report(progress, 1);
  return remesher.result();
}

}  // namespace hdpea
