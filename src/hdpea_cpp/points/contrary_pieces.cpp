// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/contrary_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/disjoint_sets.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/points/carried_normals.hpp"

namespace hdpea {
namespace {

/// Least cosine along edges within a piece: with 0.9 a chance edge may join sheets, with 0.97 noise parts one.
constexpr double least_cosine = 0.95;
/// Fewest points of a piece, most pieces, the largest first, and most of a piece's points that are asked.
constexpr std::size_t fewest_points = 24, most_pieces = 32, most_samples = 40;
/// Share of the samples at which the winding number rises beyond which a piece is turned.
constexpr double contrary = 0.75;
/// Least rise, of what it would be if all others agreed. Outside of a closed thing theirs cancel each other; of twelve
/// pieces of scanned meshes that were the wrong way round it was 0.14 at least.
constexpr double least_rise = 0.1;

using Piece = std::vector<Index>;

/// The pieces that may be turned, the largest first, without the largest of all.
std::vector<Piece> smaller_pieces(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  const Index n = points.rows();
  DisjointSets sets(n);
  for (Index i = 0; i < n; ++i) {
    for (Index j : neighbors.row(i)) {
      if (j >= 0 && carried_cosine(points, normals, i, j) > least_cosine) sets.join(i, j);
    }
  }
  std::vector<Piece> pieces(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) pieces[sets.find(i)].push_back(i);
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.size() > b.size(); });
  if (!pieces.empty()) pieces.erase(pieces.begin());
  pieces.resize(std::min(pieces.size(), most_pieces));
  while (!pieces.empty() && pieces.back().size() < fewest_points) pieces.pop_back();
  return pieces;
}

/// How the winding number falls along the normals of a piece's samples, to scale.
struct Falls {
  Eigen::MatrixXd by_piece;  ///< (s, pieces + 1): that of each piece by itself, and of all that is in none
  double points = 0;         ///< of the piece
  double size = 0;           ///< the sum of the sizes of all terms of other pieces
};

/// Sums over the points of each piece.
class Field {
 public:
  Field(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors,
        const std::vector<Piece>& pieces)
      : points_(points),
        normals_(normals),
        piece_of_(static_cast<std::size_t>(points.rows()), static_cast<Index>(pieces.size())) {
    const Eigen::VectorXd areas = neighborhood_areas(points, neighbors);
    moments_ = normals.array().colwise() * areas.array();
    // Half as wide as a neighbourhood. Less, and single points show; more, and walls have no sides.
    squared_width_ = areas.mean() / 4;
    const auto count = static_cast<Index>(pieces.size());
    for (Index p = 0; p < count; ++p) {
      for (Index i : pieces[p]) piece_of_[i] = p;
    }
    for (const Piece& piece : pieces) falls_.push_back(falls_along(piece, count + 1));
  }

  /// How much the winding number of all others rises along the normals of a piece, if these have the given signs; 0
  /// where it hardly does, or not at most samples.
  double contradiction(std::size_t piece, const Eigen::VectorXd& signs) const {
    Eigen::VectorXd others = signs;
    others[static_cast<Index>(piece)] = 0;
    const Eigen::ArrayXd fall = signs[static_cast<Index>(piece)] * (falls_[piece].by_piece * others).array();
    const bool rises = fall.sum() < -least_rise * falls_[piece].size && (fall < 0).cast<double>().mean() > contrary;
    return rises ? -fall.mean() * falls_[piece].points : 0;
  }

 private:
  Falls falls_along(const Piece& piece, Index columns) const {
    const std::size_t step = (piece.size() + most_samples - 1) / most_samples;
    const auto samples = static_cast<Index>((piece.size() + step - 1) / step);
    Falls falls{Eigen::MatrixXd::Zero(samples, columns), static_cast<double>(piece.size())};
    Eigen::VectorXd sizes = Eigen::VectorXd::Zero(samples);
    parallel_for(
        samples,
        [&](Index s) {
          const Index at = piece[static_cast<std::size_t>(s) * step];
          for (Index i = 0; i < points_.rows(); ++i) {
            const double term = fall(at, i);
            falls.by_piece(s, piece_of_[i]) += term;
            if (piece_of_[i] != piece_of_[at]) sizes[s] += std::abs(term);
          }
        },
        1);
    falls.size = sizes.sum();
    return falls;
  }

  /// Minus the derivative along the normal of one point of the winding number's kernel of another.
  double fall(Index at, Index from) const {
    const Eigen::RowVector3d offset = points_.row(from) - points_.row(at), moment = moments_.row(from);
    const double squared = offset.squaredNorm() + squared_width_;
    const double along = 3 * moment.dot(offset) / squared;
    return (moment - along * offset).dot(normals_.row(at)) / (squared * std::sqrt(squared));
  }

  const PointsRef& points_;
  const PointsRef& normals_;
  Points moments_;
  double squared_width_ = 0;
  std::vector<Index> piece_of_;  ///< of each point; the number of pieces if it is in none
  std::vector<Falls> falls_;
};

}  // namespace

Points turn_contrary_pieces(const PointsRef& points, const PointsRef& normals, const NeighborsRef& neighbors) {
  require_neighborhoods(points, normals, neighbors);
  const std::vector<Piece> pieces = smaller_pieces(points, normals, neighbors);
  if (pieces.empty()) return normals;
  const Field field(points, normals, neighbors, pieces);
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(static_cast<Index>(pieces.size()) + 1);
  Points turned = normals;
  // Each turn changes what others are told; none is turned back.
  for (std::size_t round = 0; round < pieces.size(); ++round) {
    std::size_t most_contrary = pieces.size();
    double most = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (signs[static_cast<Index>(p)] < 0) continue;
      const double contradiction = field.contradiction(p, signs);
      if (contradiction > most) {
        most = contradiction;
        most_contrary = p;
      }
    }
    if (most_contrary == pieces.size()) break;
    signs[static_cast<Index>(most_contrary)] = -1;
    for (Index i : pieces[most_contrary]) turned.row(i) *= -1;
  }
  return turned;
}

}  // namespace hdpea
