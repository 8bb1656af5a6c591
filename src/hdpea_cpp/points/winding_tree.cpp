// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/winding_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

/// Points of a leaf: they share a list of sources, and fill the lanes of the processor.
constexpr int leaf_size = 16;
/// Largest radius of a cell that is summed as one, relative to its distance from the leaf.
constexpr double opening = 0.6;

using Lanes = Eigen::Array<float, leaf_size, 1>;

/// From the targets of a leaf to one source.
struct Offset {
  Lanes x, y, z;
  Lanes cubed;    ///< 1 / distance^3
  Lanes squared;  ///< 1 / distance^2

  template <class Vector>
  Lanes dot(const Vector& v) const {
    return v[0] * x + v[1] * y + v[2] * z;
  }
  /// offset^T q offset
  template <class Tensor>
  Lanes form(const Tensor& q) const {
    return x * (q[0] * x + (q[1] + q[3]) * y) + y * (q[4] * y + (q[5] + q[7]) * z) + z * (q[8] * z + (q[2] + q[6]) * x);
  }
};

constexpr double one_over_4pi = 1 / (4 * std::numbers::pi);

}  // namespace

WindingTree::WindingTree(const PointsRef& points) : order_(static_cast<std::size_t>(points.rows())) {
  require(points.rows() >= 1, "a tree needs at least one point");
  require_finite(points, "points");
  const Eigen::RowVector3d low = points.colwise().minCoeff();
  const double diagonal = (points.colwise().maxCoeff() - low).norm();
  size_ = diagonal > 0 ? diagonal : 1;
  points_ = (points.rowwise() - low) / size_;
  std::iota(order_.begin(), order_.end(), Index{0});
  build(0, points.rows());
  points_ = points_(order_, Eigen::all).eval();
  positions_ = points_.cast<float>().array();
  centers_.resize(static_cast<Index>(nodes_.size()), 3);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    centers_.row(static_cast<Index>(n)) = nodes_[n].center.cast<float>().array();
  }
  find_interactions();
}

/// Halves the points across their longest extent; which half a point falls into depends on positions alone.
Index WindingTree::build(Index begin, Index end) {
  const auto first = order_.begin() + begin, last = order_.begin() + end;
  const Points members = points_(std::vector<Index>(first, last), Eigen::all);
  Index axis;
  (members.colwise().maxCoeff() - members.colwise().minCoeff()).maxCoeff(&axis);
  const auto node = static_cast<Index>(nodes_.size());
  nodes_.push_back({begin, end, 0, Eigen::RowVector3d::Zero(), 0});
  const auto before = [&](Index a, Index b) {
    const auto key = [&](Index i) {
      return std::tuple(points_(i, axis), points_(i, 0), points_(i, 1), points_(i, 2), i);
    };
    return key(a) < key(b);
  };
  if (end - begin <= leaf_size) {
    std::sort(first, last, before);
    leaves_.push_back(node);
  } else {
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(first, order_.begin() + middle, last, before);
    build(begin, middle);
    nodes_[node].second_child = build(middle, end);
  }
  // Only now are the points in the order that their positions determine, and with them the rounding of the sum.
  for (Index i = begin; i < end; ++i) nodes_[node].center += points_.row(order_[i]);
  nodes_[node].center /= static_cast<double>(end - begin);
  for (Index i = begin; i < end; ++i) {
    nodes_[node].radius = std::max(nodes_[node].radius, (points_.row(order_[i]) - nodes_[node].center).norm());
  }
  return node;
}

void WindingTree::find_interactions() {
  interactions_.resize(leaves_.size());
  parallel_for(
      static_cast<Index>(leaves_.size()),
      [&](Index l) {
        const Node& leaf = nodes_[leaves_[l]];
        std::vector<Index> open{0};
        while (!open.empty()) {
          const Index n = open.back();
          open.pop_back();
          const Node& node = nodes_[n];
          if (node.radius < opening * ((node.center - leaf.center).norm() - leaf.radius)) {
            interactions_[l].far.push_back(n);
          } else if (node.second_child == 0) {
            interactions_[l].near.push_back(n);
          } else {
            open.push_back(node.second_child);
            open.push_back(n + 1);
          }
        }
      },
      16);
}

/// The values of the points as sorted; of each node their sum, and their first moment about its center.
WindingTree::Sources WindingTree::sources_of(const Points& values) const {
  const auto count = static_cast<Index>(nodes_.size());
  const Points sorted = values(order_, Eigen::all);
  Points total(count, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> moment(count, 9);
  for (Index n = count - 1; n >= 0; --n) {
    const Node& node = nodes_[n];
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> first = Eigen::Matrix3d::Zero();
    const auto add = [&](const Eigen::RowVector3d& value, const Eigen::RowVector3d& position) {
      sum += value;
      first += value.transpose() * (position - node.center);
    };
    if (node.second_child == 0) {
      for (Index i = node.begin; i < node.end; ++i) add(sorted.row(i), points_.row(i));
    } else {
      for (Index child : {n + 1, node.second_child}) {
        add(total.row(child), nodes_[child].center);
        first.reshaped<Eigen::RowMajor>() += moment.row(child).transpose();
      }
    }
    total.row(n) = sum;
    moment.row(n) = first.reshaped<Eigen::RowMajor>().transpose();
  }
  return {sorted.cast<float>().array(), total.cast<float>().array(), moment.cast<float>().array()};
}

template <class Kernel>
void WindingTree::sum(const Kernel& kernel, double width) const {
  require(width > 0, "the width must be positive");
  const auto smoothing = static_cast<float>(width * width / (size_ * size_));
  parallel_for(
      static_cast<Index>(leaves_.size()),
      [&](Index l) {
        const Node& leaf = nodes_[leaves_[l]];
        Eigen::Array<float, leaf_size, 3> targets;
        for (Index lane = 0; lane < leaf_size; ++lane) {
          targets.row(lane) = positions_.row(std::min(leaf.begin + lane, leaf.end - 1));
        }
        Offset d;
        const auto look_at = [&](const auto& position) {
          d.x = position[0] - targets.col(0);
          d.y = position[1] - targets.col(1);
          d.z = position[2] - targets.col(2);
          d.squared = 1 / (d.x.square() + d.y.square() + d.z.square() + smoothing);
          d.cubed = d.squared * d.squared.sqrt();
        };
        Lanes sums[3] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
        for (Index n : interactions_[l].near) {
          for (Index i = nodes_[n].begin; i < nodes_[n].end; ++i) {
            look_at(positions_.row(i));
            kernel.add_point(i, d, sums);
          }
        }
        for (Index n : interactions_[l].far) {
          look_at(centers_.row(n));
          kernel.add_cell(n, d, sums);
        }
        for (Index i = leaf.begin; i < leaf.end; ++i) {
          const Index lane = i - leaf.begin;
          kernel.store(order_[i], Eigen::RowVector3d(sums[0][lane], sums[1][lane], sums[2][lane]) * one_over_4pi);
        }
      },
      8);
}

Eigen::VectorXd WindingTree::winding(const PointsRef& moments, double width) const {
  struct Kernel {
    Sources m;
    Eigen::VectorXd& chi;
    void add_point(Index j, const Offset& d, Lanes* sums) const { sums[0] += d.dot(m.value.row(j)) * d.cubed; }
    void add_cell(Index n, const Offset& d, Lanes* sums) const {
      const auto q = m.moment.row(n);
      const float trace = q[0] + q[4] + q[8];
      sums[0] += (d.dot(m.total.row(n)) + trace - 3 * d.form(q) * d.squared) * d.cubed;
    }
    void store(Index i, const Eigen::RowVector3d& sum) const { chi[i] = sum[0]; }
  };
  require(moments.rows() == points_.rows(), "points and moments must have one row per point");
  Eigen::VectorXd chi(moments.rows());
  sum(Kernel{sources_of(moments / (size_ * size_)), chi}, width);
  return chi;
}

Points WindingTree::normal_field(const PointsRef& moments, double width) const {
  struct Kernel {
    Sources m;
    Points& field;
    void add_point(Index j, const Offset& d, Lanes* sums) const {
      const Lanes along = 3 * d.dot(m.value.row(j)) * d.squared;
      sums[0] += (m.value(j, 0) - along * d.x) * d.cubed;
      sums[1] += (m.value(j, 1) - along * d.y) * d.cubed;
      sums[2] += (m.value(j, 2) - along * d.z) * d.cubed;
    }
    void add_cell(Index n, const Offset& d, Lanes* sums) const {
      const auto q = m.moment.row(n);
      const float trace = q[0] + q[4] + q[8];
      const Lanes along = 3 * (d.dot(m.total.row(n)) + trace - 5 * d.form(q) * d.squared) * d.squared;
      const Lanes turned = 3 * d.squared;
      const float xy = q[1] + q[3], xz = q[2] + q[6], yz = q[5] + q[7];
      sums[0] += (m.total(n, 0) - along * d.x - turned * (2 * q[0] * d.x + xy * d.y + xz * d.z)) * d.cubed;
      sums[1] += (m.total(n, 1) - along * d.y - turned * (xy * d.x + 2 * q[4] * d.y + yz * d.z)) * d.cubed;
      sums[2] += (m.total(n, 2) - along * d.z - turned * (xz * d.x + yz * d.y + 2 * q[8] * d.z)) * d.cubed;
    }
    void store(Index i, const Eigen::RowVector3d& sum) const { field.row(i) = sum; }
  };
  require(moments.rows() == points_.rows(), "points and moments must have one row per point");
  Points field(moments.rows(), 3);
  sum(Kernel{sources_of(moments / (size_ * size_)), field}, width);
  return field / size_;
}

Points WindingTree::adjoint(const Eigen::VectorXd& charges, double width) const {
  struct Kernel {
    Sources c;
    Points& field;
    void add_point(Index j, const Offset& d, Lanes* sums) const { subtract(c.value(j, 0) * d.cubed, d, sums); }
    void add_cell(Index n, const Offset& d, Lanes* sums) const {
      const auto dipole = c.moment.row(n).head<3>();
      subtract((c.total(n, 0) - 3 * d.dot(dipole) * d.squared) * d.cubed, d, sums);
      for (int axis = 0; axis < 3; ++axis) sums[axis] -= dipole[axis] * d.cubed;
    }
    static void subtract(const Lanes& weight, const Offset& d, Lanes* sums) {
      sums[0] -= weight * d.x;
      sums[1] -= weight * d.y;
      sums[2] -= weight * d.z;
    }
    void store(Index i, const Eigen::RowVector3d& sum) const { field.row(i) = sum; }
  };
  require(charges.rows() == points_.rows(), "points and charges must have one row per point");
  Points field(charges.rows(), 3), values = Points::Zero(charges.rows(), 3);
  values.col(0) = charges;
  sum(Kernel{sources_of(values), field}, width);
  return field / (size_ * size_);
}

}  // namespace hdpea
