// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// Sums over all pairs of points of the winding number's kernel, by a tree (Barnes & Hut 1986).
///
/// Points y_j with moments m_j (area times outward normal) have, in x, the smoothed winding number
///   chi(x) = sum_j m_j . (y_j - x) / (4 pi (|y_j - x|^2 + width^2)^(3/2)),
/// about 1 inside, 0 outside and 1/2 on the surface. Far points are summed as one at the middle of their cell, with
/// their first moment about it. The tree, and which of its cells are summed as one for a leaf, are found once for all
/// sums.
///
/// Sums are in single precision and in an order that the positions determine, so they depend neither on the threads
/// nor on the order of the points. Relative to its root mean square, a sum over a surface is accurate to 8 %, over
/// one whose moments have random signs to 15 %.
class WindingTree {
 public:
  /// @param points  (n, 3), n >= 1, finite and distinct
  explicit WindingTree(const PointsRef& points);

  // All for a width > 0.

  /// (n) chi in each point.
  Eigen::VectorXd winding(const PointsRef& moments, double width) const;

  /// (n, 3) minus the gradient of chi in each point: along the normals where these are consistent.
  Points normal_field(const PointsRef& moments, double width) const;

  /// (n, 3) the adjoint of `winding`: winding(m) . c = sum_j m_j . adjoint(c)_j.
  Points adjoint(const Eigen::VectorXd& charges, double width) const;

 private:
  using Values = Eigen::Array<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

  struct Node {
    Index begin, end;    ///< its points, in the tree's order
    Index second_child;  ///< the first one is the next node; 0: a leaf
    Eigen::RowVector3d center;
    double radius;
  };

  /// What is summed: of each point its value, of each node the total of its values and their moment.
  struct Sources {
    Values value, total;
    Eigen::Array<float, Eigen::Dynamic, 9, Eigen::RowMajor> moment;
  };

  /// The nodes that act on a leaf: near ones point by point, far ones as one.
  struct Interactions {
    std::vector<Index> near, far;
  };

  Index build(Index begin, Index end);
  void find_interactions();
  Sources sources_of(const Points& values) const;
  template <class Kernel>
  void sum(const Kernel& kernel, double width) const;

  Points points_;             ///< as sorted, at unit size
  std::vector<Index> order_;  ///< the point as given, of each as sorted
  double size_ = 1;
  std::vector<Node> nodes_;
  std::vector<Index> leaves_;
  Values positions_, centers_;              ///< of the points as sorted and of the nodes, as they are summed
  std::vector<Interactions> interactions_;  ///< of each leaf
};

}  // namespace hdpea
