// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

using Vector = Eigen::RowVector3d;

/// A smaller patch straddles a crease less often; the last fit uses all neighbours again.
constexpr double patch_share = 0.625;
constexpr int rounds = 3;
/// A neighbour's plane must fit better by this factor, in squared distance, to replace the point's own.
constexpr double own_advantage = 0.25;
/// Cosine of the angle below which two planes count as the same: 10 degrees.
constexpr double same_plane = 0.985;
/// Exact planes have no residual: neighbours count as on the plane within this share of the patch's radius.
constexpr double least_residual = 0.02;

struct Plane {
  Vector center, normal;
  /// Mean squared distance from the plane, and along its widest direction.
  double residual, extent;
};

class Estimation {
 public:
  Estimation(const PointsRef& points, const NeighborsRef& neighbors)
      : points_(points), neighbors_(neighbors), planes_(points.rows()) {}

  Points run() {
    const Index patch = std::max<Index>(std::min<Index>(6, neighbors_.cols()),
                                        std::lround(patch_share * static_cast<double>(neighbors_.cols())));
    replace_all([&](Index i) { return fit(i, patch, [](Index) { return 1.0; }); });
    const double tolerance = agreement_tolerance();
    for (int round = 0; round < rounds; ++round) replace_all([&](Index i) { return flattest(i); });
    replace_all([&](Index i) {
      return fit(i, neighbors_.cols(), [&](Index j) {
        return std::exp((std::abs(planes_[i].normal.dot(planes_[j].normal)) - 1) / tolerance);
      });
    });
    Points normals(points_.rows(), 3);
    for (Index i = 0; i < points_.rows(); ++i) normals.row(i) = planes_[i].normal;
    return normals;
  }

 private:
  /// All from the state before, so that no plane depends on the order of the loop.
  template <class NewPlane>
  void replace_all(NewPlane&& new_plane) {
    std::vector<Plane> replaced(planes_.size());
    parallel_for(points_.rows(), [&](Index i) { replaced[i] = new_plane(i); });
    planes_ = std::move(replaced);
  }

  /// The weighted plane of a point (of weight 1) and its first `count` neighbours.
  template <class Weight>
  Plane fit(Index i, Index count, Weight&& weight) const {
    double sum = 1;
    Vector mean = Vector::Zero();
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (Index c = 0; c < count; ++c) {
      const Index j = neighbors_(i, c);
      if (j < 0) continue;
      const double w = weight(j);
      const Vector offset = points_.row(j) - points_.row(i);
      sum += w;
      mean += w * offset;
      scatter += w * offset.transpose() * offset;
    }
    mean /= sum;
    return from_scatter(points_.row(i) + mean, scatter / sum - mean.transpose() * mean);
  }

  static Plane from_scatter(const Vector& center, const Eigen::Matrix3d& scatter) {
    if (scatter.isZero(0)) return {center, Vector::UnitZ(), 0, 0};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    Vector normal = solver.eigenvectors().col(0).transpose();
    Index largest = 0;
    normal.cwiseAbs().maxCoeff(&largest);
    if (normal[largest] < 0) normal = -normal;
    return {center, normal, std::max(solver.eigenvalues()[0], 0.0), solver.eigenvalues()[2]};
  }

  /// Noise makes the normals of one plane disagree, so with noise they may. Curvature and creases do not count
  /// as noise: they are not everywhere, hence the lower quartile.
  double agreement_tolerance() const {
    std::vector<double> thickness;
    for (const Plane& plane : planes_) thickness.push_back(plane.extent > 0 ? plane.residual / plane.extent : 0);
    const auto quartile = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 4);
    std::nth_element(thickness.begin(), quartile, thickness.end());
    return 0.05 + 5 * *quartile;
  }

  /// The plane through point i's neighbourhood that it shares with its flattest neighbour, or its own.
  Plane flattest(Index i) const {
    const Plane& own = planes_[i];
    const auto cost = [&](const Plane& plane) {
      const double distance = plane.normal.dot(points_.row(i) - plane.center);
      return plane.residual + distance * distance;
    };
    const Plane* best = &own;
    double least = own_advantage * cost(own);
    for (Index j : neighbors_.row(i)) {
      if (j < 0 || cost(planes_[j]) >= least) continue;
      best = &planes_[j];
      least = cost(*best);
    }
    if (std::abs(own.normal.dot(best->normal)) > same_plane) return own;
    const double width = 4 * std::max(best->residual, least_residual * least_residual * best->extent);
    return fit(i, neighbors_.cols(), [&](Index j) {
      const double distance = best->normal.dot(points_.row(j) - best->center);
      return std::exp(-distance * distance / width);
    });
  }

  const PointsRef& points_;
  const NeighborsRef& neighbors_;
  std::vector<Plane> planes_;
};

}  // namespace

Points estimate_normals(const PointsRef& points, const NeighborsRef& neighbors) {
  require_finite(points, "points");
  require_neighbors(neighbors, points.rows());
  if (points.rows() == 0) return Points(0, 3);
  return Estimation(points, neighbors).run();
}

}  // namespace hdpea
