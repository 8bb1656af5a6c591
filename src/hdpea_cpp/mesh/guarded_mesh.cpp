// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/guarded_mesh.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::RowVector3d;

/// No face may turn by more than the angle of this cosine, nor shrink below this share of its area by a move, or of its
/// longest edge squared by a flip.
constexpr double kLeastCosine = 0.1, kLeastShare = 0.05, kLeastOfEdge = 0.02;

bool turns(const Vector& before, const Vector& after) {
  return after.dot(before) <= kLeastCosine * after.norm() * before.norm();
}

}  // namespace

Vector GuardedMesh::area(Index f) const {
  return area_vector(at(topology_.corner(3 * f)), at(topology_.corner(3 * f + 1)), at(topology_.corner(3 * f + 2)));
}

Eigen::VectorXd GuardedMesh::mean_lengths() const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(vertices_.rows()), counts = sums;
  for (Index h = 0; h < topology_.halfedges(); ++h) {
    const double length = (at(topology_.source(h)) - at(topology_.target(h))).norm();
    for (Index v : {topology_.source(h), topology_.target(h)}) {
      sums(v) += length;
      counts(v) += 1;
    }
  }
  return sums.array() / counts.array().max(1);
}

bool GuardedMesh::move(Index v, const Vector& to) {
  const Vector from = at(v);
  const std::vector<Index> around = topology_.faces_around(v);
  std::vector<Vector> before;
  for (Index f : around) before.push_back(area(f));
  vertices_.row(v) = to;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Vector after = area(around[i]);
    if (!turns(before[i], after) && after.norm() > kLeastShare * before[i].norm()) continue;
    vertices_.row(v) = from;
    return false;
  }
  return true;
}

bool GuardedMesh::flip(Index h) {
  const Index o = topology_.opposite(h);
  const Vector a = at(topology_.source(h)), b = at(topology_.target(h)), c = at(topology_.apex(h)),
               d = at(topology_.apex(o));
  const Vector before = area(h / 3) + area(o / 3);
  const double longest = std::max((a - b).squaredNorm(), (c - d).squaredNorm());
  for (const Vector& after : {Vector(area_vector(c, a, d)), Vector(area_vector(d, b, c))}) {
    if (turns(before, after) || after.norm() < kLeastOfEdge * longest) return false;
  }
  return topology_.flip(h);
}

}  // namespace hdpea
