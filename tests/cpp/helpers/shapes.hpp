// SPDX-License-Identifier: GPL-3.0-or-later
// Small named meshes for the tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea::shapes {

struct Mesh {
  Points vertices;
  Faces faces;
};

inline Mesh make(const std::vector<Eigen::RowVector3d>& vertices,
                 const std::vector<Eigen::RowVector<Index, 3>>& faces) {
  Mesh mesh{Points(vertices.size(), 3), Faces(faces.size(), 3)};
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.row(i) = vertices[i];
  for (std::size_t i = 0; i < faces.size(); ++i) mesh.faces.row(i) = faces[i];
  return mesh;
}

inline Mesh tetrahedron() {
  return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

/// The unit square in rows x columns cells of two triangles, facing +z.
inline Mesh grid(Index rows, Index columns) {
  Mesh mesh{Points((rows + 1) * (columns + 1), 3), Faces(2 * rows * columns, 3)};
  for (Index r = 0; r <= rows; ++r) {
    for (Index c = 0; c <= columns; ++c) {
      mesh.vertices.row(r * (columns + 1) + c) << double(c) / double(columns), double(r) / double(rows), 0;
    }
  }
  for (Index r = 0, f = 0; r < rows; ++r) {
    for (Index c = 0; c < columns; ++c, f += 2) {
      const Index a = r * (columns + 1) + c, b = a + columns + 1;
      mesh.faces.row(f) << a, a + 1, b + 1;
      mesh.faces.row(f + 1) << a, b + 1, b;
    }
  }
  return mesh;
}

/// A torus of radii 1 and 0.4, of 2 n m triangles.
inline Mesh torus(Index n, Index m) {
  Mesh mesh{Points(n * m, 3), Faces(2 * n * m, 3)};
  for (Index i = 0, f = 0; i < n; ++i) {
    for (Index j = 0; j < m; ++j, f += 2) {
      const double u = 2 * std::numbers::pi * double(i) / double(n), v = 2 * std::numbers::pi * double(j) / double(m);
      const double radius = 1 + 0.4 * std::cos(v);
      mesh.vertices.row(i * m + j) << radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v);
      const Index k = (i + 1) % n, l = (j + 1) % m;
      mesh.faces.row(f) << i * m + j, k * m + j, k * m + l;
      mesh.faces.row(f + 1) << i * m + j, k * m + l, i * m + l;
    }
  }
  return mesh;
}

/// The unit sphere: vertex 0 is the south pole, then `rings` circles of `sectors` vertices, the last is the north pole.
inline Mesh sphere(Index rings, Index sectors) {
  std::vector<Eigen::RowVector3d> vertices{{0, 0, -1}};
  std::vector<Eigen::RowVector<Index, 3>> faces;
  const Index north = 1 + rings * sectors;
  for (Index r = 0; r < rings; ++r) {
    const double v = std::numbers::pi * (double(r + 1) / double(rings + 1) - 0.5);
    for (Index s = 0; s < sectors; ++s) {
      const double u = 2 * std::numbers::pi * double(s) / double(sectors);
      vertices.emplace_back(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
      const Index next = (s + 1) % sectors, a = 1 + r * sectors;
      if (r == 0) faces.push_back({0, a + next, a + s});
      if (r + 1 == rings) {
        faces.push_back({a + s, a + next, north});
      } else {
        faces.push_back({a + s, a + next, a + sectors + next});
        faces.push_back({a + s, a + sectors + next, a + sectors + s});
      }
    }
  }
  vertices.emplace_back(0, 0, 1);
  return make(vertices, faces);
}

/// The mesh without the faces that have one of these vertices.
inline Mesh without_vertices(const Mesh& mesh, const std::vector<Index>& removed) {
  std::vector<Index> kept;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    bool keep = true;
    for (Index v : removed) keep = keep && (mesh.faces.row(f).array() != v).all();
    if (keep) kept.push_back(f);
  }
  return {mesh.vertices, mesh.faces(kept, Eigen::all)};
}

}  // namespace hdpea::shapes
