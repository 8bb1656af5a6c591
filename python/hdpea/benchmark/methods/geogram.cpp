// SPDX-License-Identifier: GPL-3.0-or-later
// Two functions of Geogram for Python's ctypes, which its own binding leaves out. Built by geogram.py.

#include <geogram/basic/attributes.h>
#include <geogram/basic/command_line.h>
#include <geogram/basic/command_line_args.h>
#include <geogram/basic/logger.h>
#include <geogram/mesh/mesh.h>
#include <geogram/mesh/mesh_geometry.h>
#include <geogram/mesh/mesh_remesh.h>
#include <geogram/mesh/mesh_repair.h>
#include <geogram/points/co3ne.h>

#include <cstdint>

namespace {

GEO::Mesh* last = nullptr;  // the mesh of the last call, until it is copied

void initialize() {
  static bool done = false;
  if (done) return;
  done = true;
  GEO::initialize(GEO::GEOGRAM_INSTALL_NONE);
  for (const char* group : {"standard", "algo", "co3ne", "remesh", "opt"}) GEO::CmdLine::import_arg_group(group);
  GEO::Logger::instance()->set_quiet(true);
}

void set_vertices(GEO::Mesh& mesh, const double* points, std::int64_t count) {
  mesh.vertices.create_vertices(GEO::index_t(count));
  for (std::int64_t i = 0; i < 3 * count; ++i) mesh.vertices.point_ptr(GEO::index_t(i / 3))[i % 3] = points[i];
}

void keep(GEO::Mesh* mesh) {
  delete last;
  last = mesh;
}

}  // namespace

extern "C" {

/// Co3Ne on points with normals; triangles connect neighbours within the radius.
void hdpea_co3ne(const double* points, const double* normals, std::int64_t count, double radius) {
  initialize();
  auto* mesh = new GEO::Mesh(3);
  set_vertices(*mesh, points, count);
  {
    GEO::Attribute<double> normal;
    normal.create_vector_attribute(mesh->vertices.attributes(), "normal", 3);
    for (std::int64_t i = 0; i < 3 * count; ++i) normal[GEO::index_t(i)] = normals[i];
  }
  GEO::Co3Ne_reconstruct(*mesh, radius);
  keep(mesh);
}

/// Centroidal Voronoi remeshing in 6 dimensions, of points and scaled normals (Levy and Bonneel, 2012).
void hdpea_remesh(const double* points, std::int64_t count, const std::int64_t* faces, std::int64_t face_count,
                  std::int64_t wanted, double anisotropy) {
  initialize();
  GEO::Mesh given(3);
  set_vertices(given, points, count);
  for (std::int64_t f = 0; f < face_count; ++f) {
    given.facets.create_triangle(GEO::index_t(faces[3 * f]), GEO::index_t(faces[3 * f + 1]),
                                 GEO::index_t(faces[3 * f + 2]));
  }
  given.facets.connect();
  GEO::mesh_repair(given);
  GEO::set_anisotropy(given, anisotropy);
  auto* made = new GEO::Mesh(3);
  GEO::remesh_smooth(given, *made, GEO::index_t(wanted), 6);
  keep(made);
}

std::int64_t hdpea_vertex_count() { return last->vertices.nb(); }

std::int64_t hdpea_face_count() { return last->facets.nb(); }

/// Copies the mesh of the last call; polygons cannot occur, all facets are triangles.
void hdpea_copy(double* points, std::int64_t* faces) {
  for (GEO::index_t v = 0; v < last->vertices.nb(); ++v) {
    for (int k = 0; k < 3; ++k) points[3 * v + k] = last->vertices.point_ptr(v)[k];
  }
  for (GEO::index_t f = 0; f < last->facets.nb(); ++f) {
    for (GEO::index_t k = 0; k < 3; ++k) faces[3 * f + k] = last->facets.vertex(f, k);
  }
}

}  // extern "C"
