// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/remeshing.hpp"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/angles.hpp"
#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/cgal_mesh.hpp"

namespace hdpea {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = Kernel::Point_3;

/// A Surface_mesh has 32 bits for its half-edges, three to a face.
constexpr double kMostFaces = 1e9;

/// Relative to the requested edge length: the ends of a shorter edge differ by rounding errors only.
constexpr double kNoLength = 1e-9;

/// Whether no two faces run through an edge in the same direction, and none repeats a vertex. Of three faces at an
/// edge two do, so this is edge-manifold as well.
bool consistently_oriented(const FacesRef& faces) {
  std::vector<std::pair<Index, Index>> edges;
  for (Index f = 0; f < faces.rows(); ++f) {
    for (int corner = 0; corner < 3; ++corner) edges.emplace_back(faces(f, corner), faces(f, (corner + 1) % 3));
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end() &&
         std::none_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.first == edge.second; });
}

/// About how many triangles of an edge length cover the faces; needles are cut into as many pieces as they are long.
double expected_faces(const PointsRef& vertices, const FacesRef& faces, double edge_length) {
  double count = 0;
  for (Index f = 0; f < faces.rows(); ++f) {
    const Eigen::RowVector3d a = vertices.row(faces(f, 0)) / edge_length, b = vertices.row(faces(f, 1)) / edge_length,
                             c = vertices.row(faces(f, 2)) / edge_length;
    count += area_vector(a, b, c).norm() + (b - a).norm() + (c - b).norm() + (a - c).norm();
  }
  return count;
}

bool has_no_length(const SurfaceMesh& mesh, SurfaceMesh::Edge_index e, double edge_length) {
  const auto h = mesh.halfedge(e);
  const double least = kNoLength * edge_length;
  return CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))) < least * least;
}

/// Joins vertices that differ by rounding errors only. The needles between them have arbitrary normals, so their edges
/// would be kept as sharp and split until a vertex has only faces without area: there CGAL 5.5 crashes (issue 7345).
void collapse_edges_without_length(SurfaceMesh& mesh, double edge_length) {
  for (const auto e : mesh.edges()) {
    if (has_no_length(mesh, e, edge_length) && CGAL::Euler::does_satisfy_link_condition(e, mesh)) {
      CGAL::Euler::collapse_edge(e, mesh);
    }
  }
  mesh.collect_garbage();
  const auto edges = mesh.edges();
  if (std::any_of(edges.begin(), edges.end(), [&](auto e) { return has_no_length(mesh, e, edge_length); })) {
    throw CannotReconstruct("vertices of the mesh that lie in one place cannot be joined without a hole");
  }
}

/// Marks the vertices at which the border turns by more than the angle: CGAL would cut such corners off.
void mark_border_corners(const SurfaceMesh& mesh, double sharp_angle,
                         SurfaceMesh::Property_map<SurfaceMesh::Vertex_index, bool>& corner) {
  const double straight = cosine_of(sharp_angle);
  for (const auto h : mesh.halfedges()) {
    if (!mesh.is_border(h)) continue;
    const Point &from = mesh.point(mesh.source(h)), &at = mesh.point(mesh.target(h)),
                &to = mesh.point(mesh.target(mesh.next(h)));
    const double cosine = (at - from) * (to - at);
    corner[mesh.target(h)] = cosine < straight * std::sqrt((at - from).squared_length() * (to - at).squared_length());
  }
}

/// A face without area has no normal, so its edges are not sharp; as a patch of its own it would stop CGAL.
void unmark_degenerate_faces(const SurfaceMesh& mesh, SurfaceMesh::Property_map<SurfaceMesh::Edge_index, bool>& sharp) {
  for (const auto f : mesh.faces()) {
    if (!pmp::is_degenerate_triangle_face(f, mesh)) continue;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) sharp[mesh.edge(h)] = false;
  }
}

}  // namespace

TriangleMesh remesh_isotropically(const PointsRef& vertices, const FacesRef& faces, const RemeshingOptions& options) {
  require(options.edge_length > 0 && std::isfinite(options.edge_length), "edge_length must be positive and finite");
  require(std::isfinite(options.sharp_angle) && options.iterations >= 0,
          "sharp_angle must be finite, iterations 0 or more");
  require(faces.rows() >= 1, "remeshing needs at least one face");
  require_mesh(vertices, faces);
  require(consistently_oriented(faces), "remeshing needs at most two faces to an edge, of one orientation");
  require(expected_faces(vertices, faces, options.edge_length) <= kMostFaces,
          "edge_length is too short: more than 1e9 triangles would be made");
  SurfaceMesh mesh = to_cgal(vertices, faces);
  pmp::remove_isolated_vertices(mesh);
  collapse_edges_without_length(mesh, options.edge_length);
  auto sharp = mesh.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, options.sharp_angle, sharp);
  unmark_degenerate_faces(mesh, sharp);
  auto corner = mesh.add_property_map<SurfaceMesh::Vertex_index, bool>("v:corner", false).first;
  mark_border_corners(mesh, options.sharp_angle, corner);
  pmp::isotropic_remeshing(mesh.faces(), options.edge_length, mesh,
                           CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.iterations))
                               .number_of_relaxation_steps(3)
                               .edge_is_constrained_map(sharp)
                               .vertex_is_constrained_map(corner)
                               .relax_constraints(false));
  return from_cgal(mesh);
}

}  // namespace hdpea
