// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// The most dimensions of an embedding that remeshing works in: coordinates are held without allocation.
constexpr int kMostDimensions = 16;

/// One point of an embedding.
using Coordinate = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kMostDimensions>;

/// The points of a surface embedded in R^d, and what is known of it there.
struct EmbeddedCloud {
  CoordinatesRef coordinates;  ///< (n, d), the first three the positions in R^3
  CoordinatesRef bases;        ///< (n, 2 d): the two vectors of an orthonormal tangent basis, one after the other
  PointsRef normals;           ///< (n, 3), unit

  Eigen::RowVector3d position(Index point) const { return coordinates.row(point).head<3>(); }

  /// The foot of x in the tangent plane of a point.
  Coordinate projected(const Coordinate& x, Index point) const;
};

/// @throws InvalidArgument if there is no point, the shapes differ, or a number is not finite
void require_embedded(const EmbeddedCloud& cloud);

/// Squared distances from tangent planes in R^3, summed over points (Garland and Heckbert 1997).
struct PlaneQuadric {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double constant = 0;
  Eigen::RowVector3d normals = Eigen::RowVector3d::Zero();  ///< the sum of the planes' normals
  double count = 0;

  void add(const Eigen::RowVector3d& normal, const Eigen::RowVector3d& on);
  /// The mean squared distance of a place from the planes; 0 without any.
  double mean(const Eigen::RowVector3d& at) const;
  /// The place with the least mean squared distance plus `pull` times that from a goal.
  Eigen::RowVector3d least(const Eigen::RowVector3d& goal, double pull) const;
};

/// The cells of the vertices of a mesh: each point of the surface belongs to the nearest vertex in R^d.
class VertexCells {
 public:
  /// Calls a function with every neighbour of a vertex.
  using Neighborhood = std::function<void(Index, const std::function<void(Index)>&)>;
  /// Whether a point (first) may belong to a vertex.
  using Covering = std::function<bool(Index, Index)>;

  /// At first each point belongs to that corner of the face closest to it in R^3 which has the largest weight there:
  /// the nearest vertex in R^d may be on the other side of a wall thinner than the vertices are apart.
  ///
  /// @param sites     (v, d) of the vertices, v >= 1
  /// @param vertices  (v, 3)
  /// @param faces     (f, 3)
  VertexCells(const EmbeddedCloud& cloud, const Coordinates& sites, const PointsRef& vertices, const FacesRef& faces);

  /// Hands each point on from its vertex to nearer ones that may cover it, by way of the edges: no point gets to the
  /// far side of a wall, though the nearest vertex may be there.
  void update(const Coordinates& sites, const Neighborhood& neighbors_of, const Covering& may_cover);

  const std::vector<Index>& points(Index vertex) const { return points_[vertex]; }
  const PlaneQuadric& planes(Index vertex) const { return planes_[vertex]; }

 private:
  void gather();

  const EmbeddedCloud& cloud_;
  Eigen::Vector<Index, Eigen::Dynamic> owner_;  // (n) the vertex of each point
  std::vector<std::vector<Index>> points_;
  std::vector<PlaneQuadric> planes_;
};

}  // namespace hdpea
