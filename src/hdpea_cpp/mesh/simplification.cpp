// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/simplification.hpp"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/cgal_mesh.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"

namespace hdpea {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Point = Kernel::Point_3;
using Vertex = SurfaceMesh::Vertex_index;

// Where the planes leave a direction undetermined, the vertex goes to the middle of the edge.
constexpr double kPull = 1e-3;

constexpr Index kCollapsesPerReport = 100;

/// The part of the given surface that a vertex stands for.
struct Part {
  Eigen::Matrix4d quadric = Eigen::Matrix4d::Zero();  ///< of the planes of its faces, weighted by their area
  double area = 0;                                    ///< in R^d
  Eigen::VectorXd centroid;                           ///< in R^d
};

Part joined(const Part& a, const Part& b) {
  const double area = a.area + b.area, share = area > 0 ? b.area / area : 0.5;
  return {a.quadric + b.quadric, area, a.centroid + share * (b.centroid - a.centroid)};
}

/// The growth of the variance of two parts, times their area, when they are joined.
double variance_growth(const Part& a, const Part& b) {
  const double area = a.area + b.area;
  return area > 0 ? a.area * b.area / area * (a.centroid - b.centroid).squaredNorm() : 0;
}

Eigen::Matrix4d plane_quadric(const Eigen::Vector3d& normal, const Eigen::Vector3d& on, double weight) {
  Eigen::Vector4d plane;
  plane << normal, -normal.dot(on);
  return weight * plane * plane.transpose();
}

double triangle_area(const CoordinatesRef& coordinates, Index a, Index b, Index c) {
  const Eigen::VectorXd u = coordinates.row(b) - coordinates.row(a), v = coordinates.row(c) - coordinates.row(a);
  return std::sqrt(std::max(0.0, u.squaredNorm() * v.squaredNorm() - std::pow(u.dot(v), 2))) / 2;
}

std::vector<Part> parts_of(const SurfaceMesh& mesh, const PointsRef& vertices, const CoordinatesRef& coordinates,
                           const FacesRef& faces, double border) {
  std::vector<Part> parts(static_cast<std::size_t>(vertices.rows()));
  for (Index v = 0; v < vertices.rows(); ++v) parts[v].centroid = coordinates.row(v).transpose();
  for (Index f = 0; f < faces.rows(); ++f) {
    const Eigen::Vector3d a = vertices.row(faces(f, 0)), b = vertices.row(faces(f, 1)), c = vertices.row(faces(f, 2));
    const Eigen::Vector3d normal = area_vector(a, b, c);
    const Eigen::Matrix4d quadric = plane_quadric(normal.normalized(), a, normal.norm() / 6);
    const double area = triangle_area(coordinates, faces(f, 0), faces(f, 1), faces(f, 2));
    for (Index v : faces.row(f)) {
      parts[v].quadric += quadric;
      parts[v].area += area / 3;
    }
  }
  for (const auto h : mesh.halfedges()) {
    if (!mesh.is_border(h)) continue;
    const Index from = mesh.source(h).idx(), to = mesh.target(h).idx();
    const Index apex = mesh.target(mesh.next(mesh.opposite(h))).idx();
    const Eigen::Vector3d a = vertices.row(from), along = vertices.row(to).transpose() - a,
                          inward = vertices.row(apex).transpose() - a;
    // The plane that holds the edge and stands upright on its face.
    const Eigen::Vector3d across = along.cross(along.cross(inward)).normalized();
    const Eigen::Matrix4d quadric = plane_quadric(across, a, border * along.squaredNorm());
    parts[from].quadric += quadric;
    parts[to].quadric += quadric;
  }
  return parts;
}

/// Cost and placement of a collapse, as CGAL asks for them. CGAL copies policies: the parts are held elsewhere.
class LeastLoss {
 public:
  using Update_tag = CGAL::Tag_true;  // CGAL calls update_after_collapse only if this says so

  LeastLoss(std::vector<Part>& parts, double evenness) : parts_(&parts), evenness_(evenness) {}

  template <class PointMap>
  void initialize(const SurfaceMesh&, const PointMap&, const Kernel&) const {}

  template <class Profile>
  void update_after_collapse(const Profile& edge, Vertex kept) const {
    (*parts_)[kept.idx()] = joined(part(edge.v0()), part(edge.v1()));
  }

  // CGAL 5 has boost::optional, CGAL 6 std::optional: the types are those of its own policies.
  template <class Profile, class OptionalPoint>
  auto operator()(const Profile& edge, const OptionalPoint& placement) const {
    using OptionalCost = decltype(sms::Edge_length_cost<SurfaceMesh>()(edge, placement));
    if (!placement) return OptionalCost();
    const Part &a = part(edge.v0()), &b = part(edge.v1());
    const Eigen::Vector4d at(placement->x(), placement->y(), placement->z(), 1);
    const double squared_distance = std::max(0.0, at.dot((a.quadric + b.quadric) * at));
    return OptionalCost(squared_distance + evenness_ * variance_growth(a, b));
  }

  template <class Profile>
  auto operator()(const Profile& edge) const {
    using OptionalPoint = decltype(sms::Midpoint_placement<SurfaceMesh>()(edge));
    const Eigen::Matrix4d quadric = part(edge.v0()).quadric + part(edge.v1()).quadric;
    const Point middle = CGAL::midpoint(edge.p0(), edge.p1());
    Eigen::Matrix3d matrix = quadric.topLeftCorner<3, 3>();
    const double pull = kPull * matrix.trace();
    if (!(pull > 0)) return OptionalPoint(middle);
    matrix.diagonal().array() += pull;
    const Eigen::Vector3d right =
        pull * Eigen::Vector3d(middle.x(), middle.y(), middle.z()) - quadric.topRightCorner<3, 1>();
    const Eigen::Vector3d best = matrix.ldlt().solve(right);
    return OptionalPoint(Point(best.x(), best.y(), best.z()));
  }

 private:
  const Part& part(Vertex v) const { return (*parts_)[v.idx()]; }

  std::vector<Part>* parts_;
  double evenness_;
};

/// Stops CGAL when the budget is met; reports the progress.
class WithinBudget {
 public:
  WithinBudget(const MeshBudget& budget, const SurfaceMesh& mesh, const Progress& progress)
      : budget_(budget), progress_(&progress), first_(excess(mesh)) {}

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& edge, std::size_t, std::size_t) const {
    const Index left = excess(edge.surface_mesh());
    if (left <= 0) return true;
    if (left <= next_) {
      report(*progress_, 1 - static_cast<double>(left) / static_cast<double>(first_));
      next_ = left - kCollapsesPerReport;
    }
    return false;
  }

 private:
  Index excess(const SurfaceMesh& mesh) const {
    return std::max(static_cast<Index>(mesh.number_of_vertices()) - budget_.vertices,
                    static_cast<Index>(mesh.number_of_faces()) - budget_.faces);
  }

  MeshBudget budget_;
  const Progress* progress_;
  Index first_;
  mutable Index next_ = first_;  // CGAL asks a const predicate
};

}  // namespace

SimplifiedMesh simplify_mesh(const PointsRef& vertices, const CoordinatesRef& coordinates, const FacesRef& faces,
                             const MeshBudget& budget, const SimplificationOptions& options, const Progress& progress) {
  require_rows(coordinates, vertices.rows(), "coordinates");
  require_finite(coordinates, "coordinates");
  require(budget.vertices >= 0 && budget.faces >= 0, "the budget must be 0 or more vertices and faces");
  require(options.evenness >= 0 && options.border >= 0, "evenness and border must be 0 or more");
  const MeshCheck check = check_mesh(vertices, faces);
  require(check.manifold() && check.oriented(), "simplification needs a manifold, oriented mesh");
  SurfaceMesh mesh = to_cgal(vertices, faces);
  std::vector<Part> parts = parts_of(mesh, vertices, coordinates, faces, options.border);
  const LeastLoss loss(parts, options.evenness);
  sms::edge_collapse(
      mesh, WithinBudget(budget, mesh, progress),
      CGAL::parameters::get_cost(loss).get_placement(loss).filter(sms::Bounded_normal_change_filter<>()));
  // Vertices are numbered anew when the collapsed ones are thrown out: what belongs to them goes along.
  const auto old = mesh.add_property_map<Vertex, Vertex>("v:old").first;
  for (const Vertex v : mesh.vertices()) old[v] = v;
  TriangleMesh simplified = from_cgal(mesh);
  Coordinates centroids(simplified.vertices.rows(), coordinates.cols());
  for (const Vertex v : mesh.vertices()) centroids.row(v.idx()) = parts[old[v].idx()].centroid.transpose();
  report(progress, 1);
  return {std::move(simplified.vertices), std::move(centroids), std::move(simplified.faces)};
}

}  // namespace hdpea
