// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/candidate_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hdpea_cpp/base/area_vector.hpp"

namespace hdpea {

double CandidateShape::circumradius(const Triangle& triangle) const {
  const auto distance = [&](int i, int j) {
    return (coordinates_.row(triangle[i]) - coordinates_.row(triangle[j])).norm();
  };
  const double a = distance(1, 2), b = distance(2, 0), c = distance(0, 1);
  const double sixteen_squared_areas = (a + b + c) * (b + c - a) * (c + a - b) * (a + b - c);
  if (sixteen_squared_areas <= 0) return std::numeric_limits<double>::infinity();
  return a * b * c / std::sqrt(sixteen_squared_areas);
}

double CandidateShape::disk_radius(const Triangle& triangle) const {
  const double a = disk_radii_(triangle[0]), b = disk_radii_(triangle[1]), c = disk_radii_(triangle[2]);
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

Eigen::Vector3d CandidateShape::area_vector(const Triangle& triangle) const {
  const auto position = [&](int i) -> Eigen::Vector3d { return coordinates_.row(triangle[i]).head<3>().transpose(); };
  return hdpea::area_vector(position(0), position(1), position(2));
}

double CandidateShape::outwardness(const Triangle& triangle) const {
  return (normals_.row(triangle[0]) + normals_.row(triangle[1]) + normals_.row(triangle[2]))
      .dot(area_vector(triangle).transpose());
}

bool CandidateShape::agrees_with_points(const Triangle& triangle, double least_cosine) const {
  const Eigen::Vector3d normal = area_vector(triangle).normalized();
  double best = 0;
  for (Index i : triangle) best = std::max(best, std::abs(normals_.row(i).dot(normal.transpose())));
  return best >= least_cosine;
}

bool CandidateShape::faces_both_ways(const Triangle& triangle, double least_cosine) const {
  const Eigen::Vector3d normal = area_vector(triangle).normalized();
  double least = 0, most = 0;
  for (Index i : triangle) {
    const double cosine = normals_.row(i).dot(normal.transpose());
    least = std::min(least, cosine);
    most = std::max(most, cosine);
  }
  return -least >= least_cosine && most >= least_cosine;
}

}  // namespace hdpea
