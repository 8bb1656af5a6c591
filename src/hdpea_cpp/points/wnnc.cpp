// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/wnnc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/winding_tree.hpp"

namespace hdpea {
namespace {

/// Neighbours in which the spacing is measured.
constexpr Index patch = 16;

/// The median spacing: the side of the square of surface that belongs to each point.
double median_spacing(const PointsRef& points) {
  const Neighbors neighbors = nearest_neighbors(points, std::min(patch, points.rows() - 1));
  std::vector<double> radii(static_cast<std::size_t>(points.rows()));
  const Index last = neighbors.cols() - 1;
  for (Index i = 0; i < points.rows(); ++i) radii[i] = (points.row(neighbors(i, last)) - points.row(i)).norm();
  const auto median = radii.begin() + static_cast<std::ptrdiff_t>((radii.size() - 1) / 2);
  std::nth_element(radii.begin(), median, radii.end());
  // A disk that holds k neighbours and the point has k + 1 cells.
  return *median * std::sqrt(std::numbers::pi / static_cast<double>(neighbors.cols() + 1));
}

/// A step of steepest descent of |winding(moments) - 1/2|^2, by exact line search.
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
  require_magnitude(points, 4, "points");
  require(options.iterations >= 1 && options.first_width > 0 && options.spacings_wide > 0 &&
              std::isfinite(options.spacings_wide),
          "iterations and widths must be positive");
  Points normals = Eigen::RowVector3d::UnitZ().replicate(n, 1);
  if (n == 1) return normals;
  report(progress, 0);
  const double last = options.spacings_wide * median_spacing(points);
  require(last > 0, "most of the points coincide");
  const double diagonal = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  // The first width covers a thick shell of noise.
  const double first = std::max(options.first_width * diagonal, 2 * last);
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
