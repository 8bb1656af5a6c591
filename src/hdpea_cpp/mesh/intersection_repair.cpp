// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/intersection_repair.hpp"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/exceptions.h>

#include <cmath>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/cgal_mesh.hpp"
#include "hdpea_cpp/mesh/changes_taken_back.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/self_intersections.hpp"

namespace hdpea {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

// Each round takes in one more ring of faces around those that cut others. On meshes of raw scans the third still
// mended some; from the fourth on, a tenth of a thin goblet was cut away where its two walls cross, and more crossed.
constexpr unsigned kRounds = 3;
// What is cut off may be closed by a triangle on its own back: no piece has fewer faces than a tetrahedron.
constexpr std::size_t kFewestFaces = 4;

}  // namespace

RepairedMesh repair_self_intersections(const PointsRef& vertices, const FacesRef& faces, const PointsRef& points,
                                       double farthest) {
  const MeshCheck given = check_mesh(vertices, faces);
  require(given.manifold() && given.oriented(), "repair_self_intersections needs a manifold, oriented mesh");
  require_finite(points, "points", kLargestToTheFourth);
  require(farthest >= 0, "how far points may get must be 0 or more");
  const Index cuts = count_self_intersections(vertices, faces);
  // CGAL's smoothing needs faces with an area.
  const RepairedMesh unchanged{vertices, faces, cuts};
  if (cuts == 0 || given.degenerate_faces > 0) return unchanged;
  SurfaceMesh mesh = to_cgal(vertices, faces);
  try {
    pmp::experimental::remove_self_intersections(mesh,
                                                 CGAL::parameters::preserve_genus(false).number_of_iterations(kRounds));
  } catch (const CGAL::Failure_exception&) {
    return unchanged;  // some faces lost theirs on the way, which only builds with assertions see
  }
  pmp::keep_large_connected_components(mesh, kFewestFaces);
  pmp::remove_isolated_vertices(mesh);
  TriangleMesh repaired = from_cgal(mesh);
  if (repaired.faces.rows() == 0 || !repaired.vertices.allFinite()) return unchanged;
  if (std::isfinite(farthest)) repaired = with_losses_taken_back(vertices, faces, repaired, points, farthest);
  const MeshCheck check = check_mesh(repaired.vertices, repaired.faces);
  if (!check.manifold() || !check.oriented()) return unchanged;
  const Index left = count_self_intersections(repaired.vertices, repaired.faces);
  return left < cuts ? RepairedMesh{repaired.vertices, repaired.faces, left} : unchanged;
}

}  // namespace hdpea
