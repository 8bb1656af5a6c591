// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of what a public function of the core is given: each takes one pass and throws InvalidArgument.
#pragma once

#include <sstream>
#include <string>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Largest numbers of which squares, and products of four, can be summed without overflow, even in R^8.
constexpr double kLargestSquared = 1e150, kLargestToTheFourth = 1e70;

template <class Matrix>
void require_finite(const Matrix& matrix, const std::string& name, double largest = kLargestSquared) {
  // A NaN compares false.
  if ((matrix.array().abs() <= largest).all()) return;
  std::ostringstream message;
  message << name << " must be finite, and at most " << largest << " in magnitude";
  throw InvalidArgument(message.str());
}

/// Finite vectors, none so short that its length, squared, is 0: then it has no direction.
inline void require_directions(const PointsRef& vectors, const std::string& name) {
  require_finite(vectors, name);
  require((vectors.rowwise().squaredNorm().array() >= 1 / (kLargestSquared * kLargestSquared)).all(),
          name + " must not be 0");
}

template <class Matrix>
void require_rows(const Matrix& matrix, Index rows, const std::string& name) {
  require(matrix.rows() == rows,
          name + " must have " + std::to_string(rows) + " rows, not " + std::to_string(matrix.rows()));
}

/// Every index lies in [least, count).
template <class Matrix>
void require_indices(const Matrix& indices, Index least, Index count, const std::string& name) {
  if (indices.size() == 0) return;
  const Index lowest = indices.minCoeff(), highest = indices.maxCoeff();
  require(lowest >= least && highest < count, name + " must lie in [" + std::to_string(least) + ", " +
                                                  std::to_string(count) + "), not " +
                                                  std::to_string(lowest < least ? lowest : highest));
}

/// Neighbours of `count` points: a row for each, of points that exist, or -1.
inline void require_neighbors(const NeighborsRef& neighbors, Index count) {
  require_rows(neighbors, count, "neighbors");
  require_indices(neighbors, -1, count, "neighbors");
}

/// Finite points, a finite normal for each, and its neighbours among them.
template <class Matrix>
void require_neighborhoods(const Matrix& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  require_finite(points, "points");
  require_rows(normals, points.rows(), "normals");
  require_finite(normals, "normals");
  require_neighbors(neighbors, points.rows());
}

/// Finite vertices, and faces of vertices that exist.
inline void require_mesh(const PointsRef& vertices, const FacesRef& faces) {
  require_finite(vertices, "vertices");
  require_indices(faces, 0, vertices.rows(), "faces");
}

}  // namespace hdpea
