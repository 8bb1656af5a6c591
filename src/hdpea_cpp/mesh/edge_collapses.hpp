// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <queue>
#include <tuple>
#include <vector>

#include "hdpea_cpp/mesh/editable_mesh.hpp"
#include "hdpea_cpp/mesh/point_links.hpp"
#include "hdpea_cpp/mesh/surface_parts.hpp"

namespace hdpea {

/// What an edge collapse costs, and where its vertex goes.
struct CollapseCost {
  double evenness;  ///< cost of a squared distance in R^d, where one in R^3 costs 1
  double pull;      ///< where planes leave a direction undetermined, the vertex goes to the middle of the edge
};

/// The edges of a mesh, of which the cheapest that may be is collapsed next.
///
/// An edge whose collapse is refused waits until the mesh around it has changed.
class EdgeCollapses {
 public:
  /// @param links  nullptr if no error is to be kept
  /// @param fixed  vertices whose edges are not collapsed, or empty
  EdgeCollapses(EditableMesh& mesh, std::vector<SurfacePart>& parts, const CollapseCost& cost, PointLinks* links,
                const MaskRef& fixed = Mask());

  /// Collapses one edge; false if there is none that may be.
  bool collapse_next();

 private:
  struct Candidate {
    double cost;
    Index a, b, version_a, version_b;
    bool operator<(const Candidate& other) const {
      return std::tie(other.cost, other.a, other.b) < std::tie(cost, a, b);  // the cheapest is the top of the heap
    }
  };

  Eigen::Vector3d place_of(Index a, Index b) const;
  void offer(Index a, Index b);
  bool try_collapse(Index a, Index b);
  std::vector<NewFace> faces_after(Index a, Index b, const Eigen::Vector3d& to, const std::vector<Index>& old) const;
  void collapse(Index a, Index b, const Eigen::Vector3d& to);
  bool keeps_sides(const std::vector<NewFace>& faces) const;

  EditableMesh& mesh_;
  std::vector<SurfacePart>& parts_;
  CollapseCost cost_;
  PointLinks* links_;
  Mask fixed_;
  std::priority_queue<Candidate> candidates_;
  std::vector<Index> version_;
  std::vector<std::vector<Index>> refused_;  ///< of each vertex: the other ends of its edges that wait
};

}  // namespace hdpea
