// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/cgal_mesh.hpp"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <array>
#include <vector>

namespace hdpea {
namespace pmp = CGAL::Polygon_mesh_processing;

SurfaceMesh to_cgal(const PointsRef& vertices, const FacesRef& faces) {
  std::vector<Kernel::Point_3> points;
  for (Index v = 0; v < vertices.rows(); ++v) points.emplace_back(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  std::vector<std::array<std::size_t, 3>> triangles;
  for (Index f = 0; f < faces.rows(); ++f) {
    triangles.push_back({static_cast<std::size_t>(faces(f, 0)), static_cast<std::size_t>(faces(f, 1)),
                         static_cast<std::size_t>(faces(f, 2))});
  }
  // A Surface_mesh has no pinched vertices: this gives each fan a vertex of its own. It turns no face, since all agree.
  pmp::orient_polygon_soup(points, triangles);
  SurfaceMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  return mesh;
}

TriangleMesh from_cgal(SurfaceMesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result{Points(mesh.number_of_vertices(), 3), Faces(mesh.number_of_faces(), 3)};
  for (const auto v : mesh.vertices()) {
    const Kernel::Point_3& point = mesh.point(v);
    result.vertices.row(v.idx()) << point.x(), point.y(), point.z();
  }
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) result.faces(f.idx(), corner++) = v.idx();
  }
  return result;
}

}  // namespace hdpea
