// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/jet_fitting.hpp"

#include <CGAL/Eigen_svd.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Fitting = CGAL::Monge_via_jet_fitting<Kernel, Kernel, CGAL::Eigen_svd>;
using MongeForm = Fitting::Monge_form;
using Patch = std::vector<Kernel::Point_3>;

constexpr std::size_t kDegree = 2;
constexpr std::size_t kCoefficients = 6;
constexpr std::size_t kGrowth = 3;
constexpr double kLargestCondition = 1e8;  // beyond, the points lie on a line as far as doubles can tell
constexpr double kLeastExtent = 1e-100;    // squares of what is smaller vanish
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Jet {
  MongeForm form;
  double error;  // of the curvatures
  std::size_t fitted;

  double bend() const { return form.principal_curvatures(0) - form.principal_curvatures(1); }
  bool surer_than(const Jet& other) const { return error * other.bend() < other.error * bend(); }
};

Eigen::RowVector3d as_row(const Kernel::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

/// The point itself, which CGAL takes for the origin of the fit, and its neighbours, relative to it.
Patch patch_around(const PointsRef& points, const NeighborsRef& neighbors, Index i) {
  Patch patch{Kernel::Point_3(0, 0, 0)};
  for (Index j : neighbors.row(i)) {
    if (j < 0) continue;
    const Eigen::RowVector3d offset = points.row(j) - points.row(i);
    patch.emplace_back(offset.x(), offset.y(), offset.z());
  }
  return patch;
}

/// The standard error of the mixed term, by the residuals of the first `count` points.
double error_of(const MongeForm& form, const Patch& patch, std::size_t count) {
  const double k1 = form.principal_curvatures(0), k2 = form.principal_curvatures(1);
  double squared_residuals = 0, squared_mixed = 0;
  for (std::size_t p = 0; p < count; ++p) {
    const Kernel::Vector_3 offset = patch[p] - form.origin();
    const double x = offset * form.maximal_principal_direction(), y = offset * form.minimal_principal_direction();
    const double residual = offset * form.normal_direction() - (k1 * x * x + k2 * y * y) / 2;
    squared_residuals += residual * residual;
    squared_mixed += x * y * x * y;
  }
  const double freedom = std::max(static_cast<double>(count) - static_cast<double>(kCoefficients), 1.0);
  return std::sqrt(squared_residuals / freedom / squared_mixed);
}

/// The largest coordinate of the first `count` points, relative to the point itself.
double extent_of(const Patch& patch, std::size_t count) {
  double extent = 0;
  for (std::size_t p = 0; p < count; ++p) {
    for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, std::abs(patch[p][axis]));
  }
  return extent;
}

std::optional<Jet> fit_patch(const Patch& patch, std::size_t count) {
  // CGAL divides by the mean distance, and Eigen's decomposition of the NaN of points in one place reads anywhere.
  if (extent_of(patch, count) < kLeastExtent) return std::nullopt;
  Fitting fitting;
  const MongeForm form = fitting(patch.begin(), patch.begin() + static_cast<std::ptrdiff_t>(count), kDegree, kDegree);
  if (!(fitting.condition_number() < kLargestCondition)) return std::nullopt;
  return Jet{form, error_of(form, patch, count), count - 1};
}

/// The first jet that is certain enough, else the most certain.
std::optional<Jet> fit_growing(const Patch& patch, const JetOptions& options) {
  std::optional<Jet> best;
  if (patch.size() < kCoefficients) return best;
  for (std::size_t count = static_cast<std::size_t>(options.least_neighbors) + 1;; count *= kGrowth) {
    const bool last = count >= patch.size();
    const auto jet = fit_patch(patch, std::min(count, patch.size()));
    if (jet && (!best || jet->surer_than(*best))) best = jet;
    if (last || (jet && jet->error <= std::max(options.curvature_error, options.direction_error * jet->bend()))) {
      return best;
    }
  }
}

void write_unknown(Jets& jets, Index i) {
  jets.curvature.principal.row(i).setConstant(kUnknown);
  jets.curvature.direction1.row(i).setConstant(kUnknown);
  jets.curvature_error(i) = std::numeric_limits<double>::infinity();
  jets.fitted(i) = 0;
}

void write_jet(Jets& jets, Index i, Jet jet, const Eigen::RowVector3d& normal) {
  MongeForm& form = jet.form;
  // CGAL takes bowls for positive, we take hills; the side is given, so only the signs change.
  form.comply_wrt_given_normal({normal.x(), normal.y(), normal.z()});
  const double highest = -form.principal_curvatures(1), lowest = -form.principal_curvatures(0);
  const bool highest_first = std::abs(highest) >= std::abs(lowest);
  jets.curvature.principal.row(i) << (highest_first ? highest : lowest), (highest_first ? lowest : highest);
  jets.curvature.direction1.row(i) =
      as_row(highest_first ? form.minimal_principal_direction() : form.maximal_principal_direction());
  jets.normals.row(i) = as_row(form.normal_direction());
  jets.curvature_error(i) = jet.error;
  jets.fitted(i) = static_cast<Index>(jet.fitted);
}

}  // namespace

Jets fit_jets(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
              const JetOptions& options) {
  const Index n = points.rows();
  require_neighborhoods(points, normals, neighbors);
  require(options.least_neighbors >= static_cast<Index>(kCoefficients) - 1, "a jet needs 5 neighbours");
  Jets jets{{{n, 2}, Points(n, 3)}, normals, Eigen::VectorXd(n), Eigen::VectorX<Index>(n)};
  parallel_for(n, [&](Index i) {
    const auto jet = fit_growing(patch_around(points, neighbors, i), options);
    if (jet) {
      write_jet(jets, i, *jet, normals.row(i));
    } else {
      write_unknown(jets, i);
    }
  });
  return jets;
}

}  // namespace hdpea
