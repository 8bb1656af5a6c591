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

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/mesh/cgal_mesh.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
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

/// Least cosine between a face and the normals of its points, and between the two faces of a flipped edge, unless it
/// was less before.
constexpr double kUpright = 0.5, kUnfolded = 0.3;

/// By how much more than now a step may take points from the faces, in squared distances.
constexpr double kWorse = 1.1;

/// What points may be from the faces whatever they were before, in squared distances. All of a vertex together: so many
/// times the mean, as long as that is no more than so small a share of the spacing of the vertices, or else the mean.
/// (Four times it takes a sixth more off the accuracy of lattice_lamp; the mean itself leaves goat_head at G 0.72
/// instead of 0.76, and a sphere less even.) A single one: so many times the mean, as the rim of a thin wall is few
/// points among many, and would retreat by their sum alone.
constexpr double kTogether = 4, kNear = 0.03, kAlone = 30;

/// Mean squared distance, for the squared spacing of the vertices, that exact points count as having: what is flat
/// stays flat but for rounding, which must not hold its vertices.
constexpr double kExact = 1e-6;

/// Shares of a step that are tried, each half of the one before, until one does no harm.
constexpr int kShares = 3;

/// Squared distance of p from the triangle abc (Ericson, Real-Time Collision Detection, section 5.1.5).
double squared_distance(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double abp = ab.dot(ap), acp = ac.dot(ap);
  if (abp <= 0 && acp <= 0) return ap.squaredNorm();
  const double abp_at_b = ab.dot(bp), acp_at_b = ac.dot(bp);
  if (abp_at_b >= 0 && acp_at_b <= abp_at_b) return bp.squaredNorm();
  const double weight_c = abp * acp_at_b - abp_at_b * acp;
  if (weight_c <= 0 && abp >= 0 && abp_at_b <= 0) return (ap - abp / (abp - abp_at_b) * ab).squaredNorm();
  const double abp_at_c = ab.dot(cp), acp_at_c = ac.dot(cp);
  if (acp_at_c >= 0 && abp_at_c <= acp_at_c) return cp.squaredNorm();
  const double weight_b = abp_at_c * acp - abp * acp_at_c;
  if (weight_b <= 0 && acp >= 0 && acp_at_c <= 0) return (ap - acp / (acp - acp_at_c) * ac).squaredNorm();
  const double weight_a = abp_at_b * acp_at_c - abp_at_c * acp_at_b;
  const double to_c = acp_at_b - abp_at_b, to_b = abp_at_c - acp_at_c;
  if (weight_a <= 0 && to_c >= 0 && to_b >= 0) return (bp - to_c / (to_c + to_b) * (c - b)).squaredNorm();
  return (ap - (weight_b * ab + weight_c * ac) / (weight_a + weight_b + weight_c)).squaredNorm();
}

double area(const PointsRef& vertices, const FacesRef& faces) {
  double twice = 0;
  for (Index f = 0; f < faces.rows(); ++f) {
    twice += area_vector(vertices.row(faces(f, 0)), vertices.row(faces(f, 1)), vertices.row(faces(f, 2))).norm();
  }
  return twice / 2;
}

double angle_between(const Coordinate& u, const Coordinate& v) {
  const double lengths = std::sqrt(u.squaredNorm() * v.squaredNorm());
  return lengths > 0 ? std::acos(std::clamp(u.dot(v) / lengths, -1.0, 1.0)) : 0;
}

enum class Aim { kValence, kDelaunay };

class Remesher {
 public:
  Remesher(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
           const EdgesRef& kept_edges, const EmbeddedCloud& cloud, const AnisotropicRemeshingOptions& options)
      : cloud_(cloud),
        options_(options),
        mesh_(to_cgal(vertices, faces)),
        positions_(vertices),
        coordinates_(coordinates),
        cells_(cloud, coordinates_, vertices, faces),
        moves_(static_cast<std::size_t>(vertices.rows())),
        kept_(static_cast<std::size_t>(mesh_.number_of_edges())) {
    require(static_cast<Index>(mesh_.number_of_vertices()) == vertices.rows(), "a vertex lies on no face");
    for (const Vertex v : mesh_.vertices()) moves_[v.idx()] = !mesh_.is_isolated(v) && !mesh_.is_border(v);
    keep(kept_edges);
    double sum = 0;
    for (const Vertex v : mesh_.vertices()) sum += mesh_.is_isolated(v) ? 0 : squared_distances(std::array{v}).sum;
    const double squared_spacing = area(vertices, faces) / static_cast<double>(vertices.rows());
    const double mean = std::max(sum / static_cast<double>(cloud.coordinates.rows()), kExact * squared_spacing);
    together_ = std::max(mean, std::min(kTogether * mean, kNear * kNear * squared_spacing));
    alone_ = std::max(kAlone * mean, kNear * kNear * squared_spacing);
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
        if (mesh_.is_border(e) || kept_[e.idx()]) continue;
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
  void keep(const EdgesRef& kept_edges) {
    for (Index k = 0; k < kept_edges.rows(); ++k) {
      const Vertex a(static_cast<SurfaceMesh::size_type>(kept_edges(k, 0))),
          b(static_cast<SurfaceMesh::size_type>(kept_edges(k, 1)));
      const Halfedge h = mesh_.halfedge(a, b);
      require(mesh_.is_valid(h), "kept_edges must be edges of the mesh");
      kept_[mesh_.edge(h).idx()] = true;
      moves_[a.idx()] = moves_[b.idx()] = false;
    }
  }

  void update_cells() {
    cells_.update(
        coordinates_,
        [&](Index v, const std::function<void(Index)>& visit) {
          const Vertex vertex(static_cast<SurfaceMesh::size_type>(v));
          if (mesh_.is_isolated(vertex)) return;
          for (const Vertex u : mesh_.vertices_around_target(mesh_.halfedge(vertex))) visit(u.idx());
        },
        [&](Index point, Index v) {
          return squared_distance_from_ring(point, Vertex(static_cast<SurfaceMesh::size_type>(v))) <= alone_;
        });
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
    const double upright = std::min(uprightness(a, b, c), uprightness(b, a, d));
    if (std::min(uprightness(a, d, c), uprightness(d, b, c)) < std::min(kUpright, upright)) return false;
    const double unfolded = unit_normal(a, b, c).dot(unit_normal(b, a, d));
    return unit_normal(a, d, c).dot(unit_normal(d, b, c)) >= std::min(kUnfolded, unfolded);
  }

  /// Flips an edge, and back if that takes the points around it too far from the faces; whether it stays flipped.
  bool flip_harmlessly(Halfedge h) {
    const auto [a, b, c, d] = around(h);
    const std::array corners{a, b, c, d};
    const SquaredDistances most = allowed(corners);
    CGAL::Euler::flip_edge(h, mesh_);
    if (squared_distances(corners).within(most)) return true;
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
    const double upright = std::min(kUpright, uprightness(v));
    const SquaredDistances most = allowed(std::array{v});
    double share = 1;
    for (int tried = 0; tried < kShares; ++tried, share /= 2) {
      positions_.row(i) = from + share * (place - from);
      if (uprightness(v) >= upright && squared_distances(std::array{v}).within(most)) {
        coordinates_.row(i) += share * (target - coordinates_.row(i));
        return;
      }
    }
    positions_.row(i) = from;
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

  /// Of the points of a vertex and its neighbours; -1 if these have none.
  Index nearest_point(Vertex v, const Coordinate& x) const {
    Index best = -1;
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](Vertex u) {
      for (const Index point : cells_.points(u.idx())) {
        const double distance = (x - cloud_.coordinates.row(point)).squaredNorm();
        if (distance < least) least = distance, best = point;
      }
    };
    look(v);
    for (const Vertex u : mesh_.vertices_around_target(mesh_.halfedge(v))) look(u);
    return best;
  }

  // ---- what harms

  /// Of points from the faces around their vertices.
  struct SquaredDistances {
    double sum = 0, largest = 0;
    bool within(const SquaredDistances& most) const { return sum <= most.sum && largest <= most.largest; }
  };

  template <std::size_t count>
  SquaredDistances squared_distances(const std::array<Vertex, count>& vertices) const {
    SquaredDistances found;
    for (const Vertex v : vertices) {
      for (const Index point : cells_.points(v.idx())) {
        const double squared = squared_distance_from_ring(point, v);
        found.sum += squared;
        found.largest = std::max(found.largest, squared);
      }
    }
    return found;
  }

  double squared_distance_from_ring(Index point, Vertex v) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      if (mesh_.is_border(h)) continue;
      least = std::min(least, squared_distance(cloud_.position(point), positions_.row(v.idx()),
                                               positions_.row(mesh_.target(mesh_.next(h)).idx()),
                                               positions_.row(mesh_.source(h).idx())));
    }
    return least;
  }

  /// The most that squared_distances may be after a step.
  template <std::size_t count>
  SquaredDistances allowed(const std::array<Vertex, count>& vertices) const {
    double points = 0;
    for (const Vertex v : vertices) points += static_cast<double>(cells_.points(v.idx()).size());
    const SquaredDistances now = squared_distances(vertices);
    return {std::max(kWorse * now.sum, together_ * points), std::max(kWorse * now.largest, alone_)};
  }

  Vector unit_normal(Vertex a, Vertex b, Vertex c) const {
    return area_vector(positions_.row(a.idx()), positions_.row(b.idx()), positions_.row(c.idx())).normalized();
  }

  /// The cosine between a face and the mean normal of its corners' points; 1 if these have none.
  double uprightness(Vertex a, Vertex b, Vertex c) const {
    const Vector normals =
        cells_.planes(a.idx()).normals + cells_.planes(b.idx()).normals + cells_.planes(c.idx()).normals;
    const double length = normals.norm();
    return length > 0 ? unit_normal(a, b, c).dot(normals) / length : 1;
  }

  /// The least of the faces around a vertex.
  double uprightness(Vertex v) const {
    double least = 1;
    for (const Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v))) {
      if (!mesh_.is_border(h)) least = std::min(least, uprightness(mesh_.source(h), v, mesh_.target(mesh_.next(h))));
    }
    return least;
  }

  const EmbeddedCloud& cloud_;
  const AnisotropicRemeshingOptions& options_;
  SurfaceMesh mesh_;
  Points positions_;         // in R^3
  Coordinates coordinates_;  // in R^d
  VertexCells cells_;
  std::vector<char> moves_;          // of each vertex
  std::vector<char> kept_;           // of each edge
  double together_ = 0, alone_ = 0;  // the squared distance that points of a vertex may have on average, and one
};

}  // namespace

EmbeddedMesh remesh_anisotropically(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                                    const EdgesRef& kept_edges, const EmbeddedCloud& cloud,
                                    const AnisotropicRemeshingOptions& options, const Progress& progress) {
  require_embedded(cloud);
  require_rows(coordinates, vertices.rows(), "coordinates");
  require(coordinates.cols() == cloud.coordinates.cols(), "vertices and points must lie in the same dimension");
  require_finite(coordinates, "coordinates", kLargestToTheFourth);
  require_finite(vertices, "vertices", kLargestToTheFourth);
  require(faces.rows() >= 1, "remeshing needs at least one face");
  require_indices(kept_edges, 0, vertices.rows(), "kept_edges");
  require(options.rounds >= 0 && options.step >= 0 && options.pull > 0,
          "rounds and step must be 0 or more, pull positive");
  const MeshCheck check = check_mesh(vertices, faces);
  require(check.manifold() && check.oriented(), "remeshing needs a manifold, oriented mesh");
  Remesher remesher(vertices, coordinates, faces, kept_edges, cloud, options);
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
