// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/remeshing.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

#include "hdpea_cpp/errors.hpp"

namespace hdpea {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;

SurfaceMesh to_cgal(const PointsRef& vertices, const FacesRef& faces) {
  std::vector<Point> points;
  for (Index v = 0; v < vertices.rows(); ++v) points.emplace_back(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  std::vector<std::array<std::size_t, 3>> triangles;
  for (Index f = 0; f < faces.rows(); ++f) {
    triangles.push_back({static_cast<std::size_t>(faces(f, 0)), static_cast<std::size_t>(faces(f, 1)),
                         static_cast<std::size_t>(faces(f, 2))});
  }
  // A Surface_mesh has no pinched vertices: this gives each fan a vertex of its own.
  pmp::orient_polygon_soup(points, triangles);
  require(pmp::is_polygon_soup_a_polygon_mesh(triangles), "remeshing needs an edge-manifold mesh");
  SurfaceMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  return mesh;
}

TriangleMesh from_cgal(SurfaceMesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result{Points(mesh.number_of_vertices(), 3), Faces(mesh.number_of_faces(), 3)};
  for (const auto v : mesh.vertices()) {
    const Point& point = mesh.point(v);
    result.vertices.row(v.idx()) << point.x(), point.y(), point.z();
  }
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) result.faces(f.idx(), corner++) = v.idx();
  }
  return result;
}

}  // namespace

TriangleMesh remesh_isotropically(const PointsRef& vertices, const FacesRef& faces, const RemeshingOptions& options) {
  require(options.edge_length > 0, "edge_length must be positive");
  require(vertices.allFinite(), "a coordinate is not finite");
  require(faces.size() > 0 && faces.minCoeff() >= 0 && faces.maxCoeff() < vertices.rows(),
          "remeshing needs faces, all of vertices that exist");
  SurfaceMesh mesh = to_cgal(vertices, faces);
  auto sharp = mesh.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, options.sharp_angle, sharp);
  pmp::isotropic_remeshing(mesh.faces(), options.edge_length, mesh,
                           CGAL::parameters::number_of_iterations(static_cast<unsigned>(options.iterations))
                               .number_of_relaxation_steps(3)
                               .edge_is_constrained_map(sharp)
                               .relax_constraints(false));
  return from_cgal(mesh);
}

}  // namespace hdpea
