// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/boundary_loops.hpp"

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {

std::vector<Loop> boundary_loops(const FacesRef& faces, Index vertices,
                                 const std::function<bool(Index, Index)>& has_edge) {
  std::vector<Index> next(static_cast<std::size_t>(vertices), -1);
  for (Index f = 0; f < faces.rows(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Index from = faces(f, i), to = faces(f, (i + 1) % 3);
      if (has_edge(to, from)) continue;
      require(next[to] < 0, "the border of the mesh must not touch itself at a vertex");
      next[to] = from;
    }
  }
  std::vector<Loop> found;
  for (Index start = 0; start < vertices; ++start) {
    if (next[start] < 0) continue;
    Loop& loop = found.emplace_back();
    for (Index v = start; next[v] >= 0;) {
      loop.push_back(v);
      const Index following = next[v];
      next[v] = -1;
      v = following;
    }
  }
  return found;
}

double perimeter(const PointsRef& vertices, const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum += (vertices.row(loop[(i + 1) % loop.size()]) - vertices.row(loop[i])).norm();
  }
  return sum;
}

double vector_area(const PointsRef& vertices, const Loop& loop) {
  Eigen::RowVector3d twice = Eigen::RowVector3d::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    twice += area_vector(vertices.row(loop[0]), vertices.row(loop[i]), vertices.row(loop[i + 1]));
  }
  return twice.norm() / 2;
}

}  // namespace hdpea
