// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hdpea_cpp/mesh/editable_mesh.hpp"

namespace hdpea {

/// The points that a mesh is to show, each as a disk of the surface.
struct DisksRef {
  PointsRef points;                         ///< (n, 3)
  PointsRef normals;                        ///< (n, 3) unit
  Eigen::Ref<const Eigen::VectorXd> radii;  ///< (n) of the disks
};

/// A triangle that may take the place of a face.
struct NewFace {
  Index number;  ///< of the face
  Eigen::Vector3d corners[3];
  int moved = -1;  ///< which corner can still be put elsewhere
};

/// The points of a cloud, each linked to the face of a mesh that it lies on; tells whether a change of the mesh keeps
/// it within an error of them, both ways.
///
/// Every point must lie within the error of its face, and every place of a face (tried at about the spacing of the
/// points) within the error of the disk of one of its 24 nearest points. Where it is more already, it may not grow.
/// Disks that face away from a face count as farther by the error: lest it folds where the error is wider than the
/// noise.
class PointLinks {
 public:
  PointLinks(const EditableMesh& mesh, const DisksRef& disks, double error);
  ~PointLinks();

  /// Whether the error is kept when these faces take the place of the faces `old`.
  bool allows(const std::vector<Index>& old, const std::vector<NewFace>& faces) const;

  /// By how much to shift the moved corner of these faces so that the worst point comes within the error; nothing if
  /// that is no small matter: for many points, or far from the corner.
  std::optional<Eigen::Vector3d> correction(const std::vector<Index>& old, const std::vector<NewFace>& faces) const;

  /// Links the points of the faces `old` to these, which have taken their place.
  void replace(const std::vector<Index>& old, const std::vector<NewFace>& faces);

 private:
  struct Nearest;
  double limit(Index p) const;
  double place_distance(const Eigen::Vector3d& at, const Eigen::Vector3d& facing, double enough) const;
  double worst_place(const NewFace& face, double enough) const;

  DisksRef disks_;
  double error_, scale_;
  std::unique_ptr<Nearest> nearest_;
  std::vector<std::vector<Index>> points_of_;  ///< of each face
  std::vector<double> distance_;               ///< of each point from its face
  std::vector<double> worst_;                  ///< of each face: the distance of its worst place, 0 if within the error
};

}  // namespace hdpea
