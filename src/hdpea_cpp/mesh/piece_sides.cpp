// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/piece_sides.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/area_vector.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"

namespace hdpea {
namespace {

constexpr double kMostOpen = 0.25;  // vector area of a piece that has an inside, in areas
constexpr double kLying = 0.7;      // the same, downwards, of what was rather seen from above: all of it, and a piece
constexpr Index kProbes = 5;        // vertices of a piece that vote on whether it is within another
/// Length of its borders, in square roots of its area, up to which a piece with gaps is as good as closed.
/// A ball with a hole whose radius is a seventh of its own has 0.25; a box without its lid has 1.8, half a ball 2.5.
constexpr double kMostBorder = 0.25;

struct Piece {
  std::vector<Index> faces;
  Eigen::AlignedBox3d box;
  double area = 0, volume = 0;
  Eigen::RowVector3d vector_area = Eigen::RowVector3d::Zero();
  double border = 0;   // length
  bool closed = true;  // has no border, not even one of length 0

  bool holds_things() const { return border <= kMostBorder * std::sqrt(area); }
  bool lies_face_down() const { return !closed && vector_area.z() < -kLying * area; }
};

class Pieces {
 public:
  Pieces(const PointsRef& vertices, const FacesRef& faces) : vertices_(vertices), faces_(faces) {
    gather();
    for (Piece& piece : pieces_) measure(piece);
    find_borders();
  }

  const std::vector<Piece>& all() const { return pieces_; }
  bool is_within_another(const Piece& piece) const;

 private:
  Eigen::RowVector3d corner(Index f, int i) const { return vertices_.row(faces_(f, i)); }
  void gather();
  void measure(Piece& piece) const;
  void find_borders();
  bool winds_around(const Piece& piece, const Eigen::RowVector3d& place) const;

  const PointsRef& vertices_;
  const FacesRef& faces_;
  std::vector<Piece> pieces_;
  std::vector<Index> piece_of_;  // of each face
};

void Pieces::gather() {
  DisjointSets sets(vertices_.rows());
  for (Index f = 0; f < faces_.rows(); ++f) {
    sets.join(faces_(f, 0), faces_(f, 1));
    sets.join(faces_(f, 1), faces_(f, 2));
  }
  std::vector<Index> number(static_cast<std::size_t>(vertices_.rows()), -1);
  for (Index f = 0; f < faces_.rows(); ++f) {
    Index& piece = number[sets.find(faces_(f, 0))];
    if (piece < 0) {
      piece = static_cast<Index>(pieces_.size());
      pieces_.emplace_back();
    }
    pieces_[piece].faces.push_back(f);
    piece_of_.push_back(piece);
  }
}

void Pieces::measure(Piece& piece) const {
  for (Index f : piece.faces) {
    for (int i = 0; i < 3; ++i) piece.box.extend(corner(f, i).transpose());
  }
  const Eigen::RowVector3d middle = piece.box.center().transpose();
  for (Index f : piece.faces) {
    const Eigen::RowVector3d area = area_vector(corner(f, 0), corner(f, 1), corner(f, 2)) / 2;
    piece.area += area.norm();
    piece.vector_area += area;
    piece.volume += area.dot(corner(f, 0) - middle) / 3;
  }
}

void Pieces::find_borders() {
  std::vector<std::pair<std::pair<Index, Index>, Index>> edges;  // ends and face
  for (Index f = 0; f < faces_.rows(); ++f) {
    for (int i = 0; i < 3; ++i) edges.push_back({std::minmax({faces_(f, i), faces_(f, (i + 1) % 3)}), f});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const bool before = e > 0 && edges[e - 1].first == edges[e].first;
    const bool after = e + 1 < edges.size() && edges[e + 1].first == edges[e].first;
    if (before || after) continue;
    const auto& [ends, face] = edges[e];
    Piece& piece = pieces_[piece_of_[face]];
    piece.closed = false;
    piece.border += (vertices_.row(ends.first) - vertices_.row(ends.second)).norm();
  }
}

/// By its winding number, the sum of the solid angles of its faces (Van Oosterom & Strackee 1983).
bool Pieces::winds_around(const Piece& piece, const Eigen::RowVector3d& place) const {
  if (!piece.box.contains(place.transpose())) return false;
  double angle = 0;
  for (Index f : piece.faces) {
    const Eigen::RowVector3d a = corner(f, 0) - place, b = corner(f, 1) - place, c = corner(f, 2) - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(angle) > 2 * std::numbers::pi;
}

bool Pieces::is_within_another(const Piece& piece) const {
  const Index count = static_cast<Index>(piece.faces.size()), probes = std::min(kProbes, count);
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& other) {
    if (&other == &piece || !other.holds_things()) return false;
    // Those that touch overlap by a few vertices at most.
    Index within = 0;
    for (Index k = 0; k < probes; ++k) within += winds_around(other, corner(piece.faces[k * count / probes], 0));
    return 2 * within > probes;
  });
}

}  // namespace

FacedMesh face_outwards(const PointsRef& vertices, const FacesRef& faces) {
  require_mesh(vertices, faces);
  const Pieces pieces(vertices, faces);
  FacedMesh faced{faces};
  double area = 0, upwards = 0;
  for (const Piece& piece : pieces.all()) {
    area += piece.area;
    upwards += piece.vector_area.z();
    if (piece.vector_area.norm() > kMostOpen * piece.area) faced.sideless += piece.area;
  }
  for (const Piece& piece : pieces.all()) {
    const bool face_down = upwards < -kLying * area && piece.lies_face_down();
    const bool within = piece.volume < 0 && piece.holds_things() && pieces.is_within_another(piece);
    faced.within += within;
    if (!face_down && !(piece.closed && piece.volume < 0 && !within)) continue;
    for (Index f : piece.faces) std::swap(faced.faces(f, 1), faced.faces(f, 2));
    ++faced.turned;
  }
  if (area > 0) faced.sideless /= area;
  return faced;
}

}  // namespace hdpea
