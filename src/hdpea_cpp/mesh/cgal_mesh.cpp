// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/cgal_mesh.hpp"

namespace hdpea {

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
