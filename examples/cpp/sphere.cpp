// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a sphere, without normals, become a closed mesh: the core of hdpea without Python.
//
//     sphere sphere.obj
//
// Vertices are farthest-point samples in R^3, so the triangles are isotropic. Coordinates in R^8, from
// solve_embedding(), in place of the positions make them anisotropic.
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>

#include "hdpea_cpp/mesh/hole_filling.hpp"
#include "hdpea_cpp/mesh/manifold_extraction.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/refinement.hpp"
#include "hdpea_cpp/points/farthest_point_sampling.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/normals.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"
#include "hdpea_cpp/points/wnnc.hpp"

namespace {

using namespace hdpea;

/// Points of the unit sphere along a spiral, evenly spaced.
Points points_of_sphere(Index count) {
  Points points(count, 3);
  for (Index i = 0; i < count; ++i) {
    const double z = 1 - (2 * double(i) + 1) / double(count), radius = std::sqrt(1 - z * z);
    const double angle = 2.399963229728653 * double(i);  // the golden angle
    points.row(i) << radius * std::cos(angle), radius * std::sin(angle), z;
  }
  return points;
}

TriangleMesh reconstruct(const Points& points, Index vertices) {
  // wnnc_normals() knows which side is out, but not the exact direction; estimate_normals() knows only that.
  const Points outward = wnnc_normals(points);
  Points normals = estimate_normals(points, nearest_neighbors(points, 16));
  for (Index i = 0; i < normals.rows(); ++i) {
    if (normals.row(i).dot(outward.row(i)) < 0) normals.row(i) *= -1;
  }

  const auto samples = farthest_point_sampling(points, vertices, {0});
  const Points seeds = points(samples, Eigen::all), seed_normals = normals(samples, Eigen::all);
  const Neighbors around = nearest_neighbors(seeds, 40);

  // Disks of 1.8 spacings hold the Voronoi cells that are cut from them.
  double spacing = 0;
  for (Index i = 0; i < vertices; ++i) spacing += (seeds.row(around(i, 0)) - seeds.row(i)).norm() / double(vertices);
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(vertices, 1.8 * spacing);
  const Candidates candidates = restricted_voronoi_candidates(seeds, tangent_bases_across(seed_normals), around, radii);

  const ExtractedMesh extracted = extract_manifold(seeds, seed_normals, radii, candidates, {});
  const FilledMesh closed = fill_holes(seeds(extracted.sources, Eigen::all), extracted.faces, 4 * spacing);
  return {refine_vertices(closed.vertices, closed.faces, points, normals, {}), closed.faces};
}

void write_obj(const char* path, const TriangleMesh& mesh) {
  std::ofstream file(path);
  const Eigen::IOFormat row(Eigen::FullPrecision, Eigen::DontAlignCols);
  for (Index v = 0; v < mesh.vertices.rows(); ++v) file << "v " << mesh.vertices.row(v).format(row) << '\n';
  for (Index f = 0; f < mesh.faces.rows(); ++f) file << "f " << (mesh.faces.row(f).array() + 1).format(row) << '\n';
  if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: sphere OUT.obj\n";
    return EXIT_FAILURE;
  }
  try {
    const TriangleMesh mesh = reconstruct(points_of_sphere(5'000), 500);
    const MeshCheck check = check_mesh(mesh.vertices, mesh.faces);
    write_obj(argv[1], mesh);
    std::cout << check.vertices << " vertices, " << check.faces << " faces, " << (check.closed() ? "closed" : "open")
              << '\n';
    return check.manifold() && check.closed() && check.genus() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
