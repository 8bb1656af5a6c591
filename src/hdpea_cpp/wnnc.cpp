// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/wnnc.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hdpea_cpp/errors.hpp"
#include "hdpea_cpp/neighbors.hpp"
#include "hdpea_cpp/parallel.hpp"
#include "hdpea_cpp/winding_tree.hpp"

namespace hdpea {
namespace {

/// Neighbours in which spacing and noise are measured.
constexpr Index patch = 16;

/// The value that this share of the values falls below.
double quantile(std::vector<double> values, double share) {
  const auto rank = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

/// The least width at which the winding number is still that of a surface, not of its single points or their noise.
double last_width(const PointsRef& points, const WnncOptions& options) {
  const Neighbors neighbors = nearest_neighbors(points, std::min(patch, points.rows() - 1));
  const Index k = neighbors.cols();
  std::vector<double> spacing(static_cast<std::size_t>(points.rows())), noise(spacing.size());
  parallel_for(points.rows(), [&](Index i) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> offsets(k + 1, 3);
    offsets.row(0).setZero();
    for (Index c = 0; c < k; ++c) offsets.row(c + 1) = points.row(neighbors(i, c)) - points.row(i);
    // A disk that holds k + 1 points has k + 1 cells.
    spacing[i] = offsets.row(k).norm() * std::sqrt(std::numbers::pi / static_cast<double>(k + 1));
    offsets.rowwise() -= offsets.colwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(offsets.transpose() * offsets, Eigen::EigenvaluesOnly);
    noise[i] = std::sqrt(std::max(solver.eigenvalues()[0], 0.0) / static_cast<double>(k + 1));
  });
  // Curvature and creases do not count as noise: they are not everywhere, hence the lower quartile.
  return std::max(options.spacings_wide * quantile(spacing, 0.5), options.noises_wide * quantile(noise, 0.25));
}

/// A step down |winding(moments) - 1/2|^2, as far as it goes down.
void approach_half(const WindingTree& tree, double width, Points& moments) {
  const Eigen::VectorXd missing = 0.5 - tree.winding(moments, width).array();
  const Points direction = tree.adjoint(missing, width);
  const double gain = tree.winding(direction, width).squaredNorm();
  if (gain > 0) moments += direction * (direction.squaredNorm() / gain);
}

}  // namespace

Points wnnc_normals(const PointsRef& points, const WnncOptions& options, const Progress& progress) {
  const Index n = points.rows();
  require(n >= 1, "wnnc_normals needs at least one point");
  require(points.allFinite(), "a coordinate is not finite");
  require(options.iterations >= 1 && options.first_width > 0 && options.spacings_wide > 0 && options.noises_wide >= 0,
          "iterations and widths must be positive");
  Points normals = Eigen::RowVector3d::UnitZ().replicate(n, 1);
  if (n == 1) return normals;
  report(progress, 0);
  const double last = last_width(points, options);
  const double diagonal = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  const double first = std::max(options.first_width * diagonal, last);
  const WindingTree tree(points);
  Points moments = Points::Zero(n, 3);
  for (int step = 1; step <= options.iterations; ++step) {
    const double width = first * std::pow(last / first, double(step) / options.iterations);
    approach_half(tree, width, moments);
    const Points field = tree.normal_field(moments, width);
    parallel_for(n, [&](Index i) {
      const double size = field.row(i).stableNorm();
      if (size > 0) normals.row(i) = field.row(i) / size;
      moments.row(i) = moments.row(i).norm() * normals.row(i);
    });
    report(progress, double(step) / options.iterations);
  }
  return normals;
}

}  // namespace hdpea
