// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/manifold_extraction.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/angles.hpp"
#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/candidate_shape.hpp"
#include "hdpea_cpp/mesh/contrary_patches.hpp"
#include "hdpea_cpp/mesh/incremental_manifold.hpp"
#include "hdpea_cpp/mesh/pinched_vertices.hpp"

namespace hdpea {
namespace {

using Verdict = IncrementalManifold::Verdict;

class Extractor {
 public:
  Extractor(const CoordinatesRef& coordinates, const PointsRef& normals,
            const Eigen::Ref<const Eigen::VectorXd>& disk_radii, const ExtractionOptions& options)
      : shape_(coordinates, normals, disk_radii),
        options_(options),
        least_fold_cosine_(cosine_of(options.max_fold)),
        least_normal_cosine_(cosine_of(options.max_normal_angle)),
        least_lone_cosine_(cosine_of(options.max_lone_angle)),
        mesh_(coordinates.rows()) {}

  void insert_candidates(const Candidates& candidates);
  ExtractedMesh finish();

 private:
  struct Candidate {
    Triangle triangle;
    int count;
    double radius;
    /// Best first; the triangle itself breaks ties.
    auto rank() const { return std::tuple(-count, radius, triangle); }
  };

  bool folds_back(const Triangle& triangle) const;
  bool touches_enough(const Triangle& triangle, bool bridging);
  bool joins_pieces(Index face, Index vertex);
  bool turns_a_piece(const Triangle& triangle);
  void insert(const Triangle& triangle);
  /// Counts what is refused for good; returns whether the triangle was inserted.
  bool try_insert(const Candidate& candidate);
  /// Inserts what shares enough edges with the mesh, until nothing more does; returns what was not inserted.
  std::vector<Candidate> sweep_t12(std::vector<Candidate> waiting, bool bridging);

  CandidateShape shape_;
  const ExtractionOptions& options_;
  double least_fold_cosine_, least_normal_cosine_, least_lone_cosine_;
  IncrementalManifold mesh_;
  /// How well the orientation of a piece's representative (a face) agrees with the normals of the piece's points.
  std::vector<double> outward_;
  ExtractionCounts counts_;
};

bool Extractor::folds_back(const Triangle& triangle) const {
  const Eigen::Vector3d normal = shape_.area_vector(triangle).normalized();
  for (int i = 0; i < 3; ++i) {
    const Index a = triangle[i], b = triangle[(i + 1) % 3];
    const Index neighbor = mesh_.faces_at(a, b)[0];
    if (neighbor < 0) continue;
    const Triangle& other = mesh_.triangles()[neighbor];
    const double cosine = normal.dot(shape_.area_vector(other).normalized());
    if ((IncrementalManifold::opposite_parity(triangle, other, a, b) ? -cosine : cosine) < least_fold_cosine_)
      return true;
  }
  return false;
}

bool Extractor::touches_enough(const Triangle& triangle, bool bridging) {
  int shared = 0;
  Index opposite = -1, face = -1;
  for (int i = 0; i < 3; ++i) {
    const Index at_edge = mesh_.faces_at(triangle[i], triangle[(i + 1) % 3])[0];
    if (at_edge < 0) continue;
    ++shared;
    opposite = triangle[(i + 2) % 3];
    face = at_edge;
  }
  if (shared != 1) return shared > 1;
  if (!mesh_.faces_of(opposite).empty()) return bridging && joins_pieces(face, opposite);
  return shape_.agrees_with_points(triangle, least_lone_cosine_);
}

/// Whether no face of the vertex is in the same edge-connected piece as the face, and one side is a fragment: large
/// parts that are near each other stay apart.
bool Extractor::joins_pieces(Index face, Index vertex) {
  const Index piece = mesh_.piece_of(face).first;
  const std::vector<Index>& others = mesh_.faces_of(vertex);
  const auto same = [&](Index other) { return mesh_.piece_of(other).first == piece; };
  const auto small = [&](Index other) { return mesh_.piece_size(other) <= options_.max_bridged_faces; };
  return std::none_of(others.begin(), others.end(), same) &&
         (small(face) || std::all_of(others.begin(), others.end(), small));
}

/// Whether the triangle joins two large pieces such that one of them faces against its points: things that touch.
bool Extractor::turns_a_piece(const Triangle& triangle) {
  bool out = false, in = false;
  for (const auto& [piece, flipped] : mesh_.pieces_beside(triangle)) {
    if (mesh_.piece_size(piece) <= options_.max_bridged_faces) continue;
    ((outward_[piece] < 0) == flipped ? out : in) = true;
  }
  return out && in;
}

void Extractor::insert(const Triangle& triangle) {
  const auto joined = mesh_.pieces_beside(triangle);
  const Index face = static_cast<Index>(mesh_.triangles().size());
  mesh_.insert(triangle);
  outward_.push_back(0);
  const auto [representative, flipped] = mesh_.piece_of(face);
  double outward = flipped ? -shape_.outwardness(triangle) : shape_.outwardness(triangle);
  for (const auto& [piece, _] : joined) outward += mesh_.piece_of(piece).second ? -outward_[piece] : outward_[piece];
  outward_[representative] = outward;
}

bool Extractor::try_insert(const Candidate& candidate) {
  const auto refuse = [](Index& counter) {
    ++counter;
    return false;
  };
  if (candidate.radius > options_.max_circumradius * shape_.disk_radius(candidate.triangle))
    return refuse(counts_.refused_size);
  if (!shape_.agrees_with_points(candidate.triangle, least_normal_cosine_)) return refuse(counts_.refused_normal);
  switch (mesh_.check(candidate.triangle)) {
    case Verdict::crowded_edge:
      return refuse(counts_.refused_edge);
    case Verdict::broken_link:
      return refuse(counts_.refused_link);
    case Verdict::not_orientable:
      return refuse(counts_.refused_orientation);
    case Verdict::fits:
      break;
  }
  if (turns_a_piece(candidate.triangle)) return refuse(counts_.refused_sides);
  insert(candidate.triangle);
  return true;
}

std::vector<Extractor::Candidate> Extractor::sweep_t12(std::vector<Candidate> waiting, bool bridging) {
  bool entered = true;
  while (entered) {
    entered = false;
    std::vector<Candidate> later;
    for (const Candidate& candidate : waiting) {
      if (!touches_enough(candidate.triangle, bridging)) {
        later.push_back(candidate);
      } else if (folds_back(candidate.triangle)) {
        ++counts_.refused_fold;
      } else if (try_insert(candidate)) {
        ++counts_.t12_kept;
        entered = true;
      }
    }
    waiting.swap(later);
  }
  return waiting;
}

void Extractor::insert_candidates(const Candidates& candidates) {
  std::vector<Candidate> t3, contested, t12;
  for (Index t = 0; t < candidates.triangles.rows(); ++t) {
    const Triangle triangle{candidates.triangles(t, 0), candidates.triangles(t, 1), candidates.triangles(t, 2)};
    (candidates.counts(t) == 3 ? t3 : t12).push_back({triangle, candidates.counts(t), shape_.circumradius(triangle)});
  }
  const auto better = [](const Candidate& a, const Candidate& b) { return a.rank() < b.rank(); };
  std::sort(t3.begin(), t3.end(), better);
  std::sort(t12.begin(), t12.end(), better);
  counts_.t3 = static_cast<Index>(t3.size());
  counts_.t12 = static_cast<Index>(t12.size());
  // What may join two sheets waits until these are large enough to know which way they face.
  for (const Candidate& candidate : t3) {
    if (shape_.faces_both_ways(candidate.triangle, least_normal_cosine_)) {
      contested.push_back(candidate);
    } else {
      counts_.t3_kept += try_insert(candidate);
    }
  }
  for (const Candidate& candidate : contested) counts_.t3_kept += try_insert(candidate);
  // Bridges come last: on thin parts they join fragments, elsewhere the surface is complete by then.
  std::vector<Candidate> loose = sweep_t12(std::move(t12), false);
  loose = sweep_t12(std::move(loose), true);
  counts_.refused_loose = static_cast<Index>(loose.size());
}

ExtractedMesh Extractor::finish() {
  const Index face_count = static_cast<Index>(mesh_.triangles().size());
  // Even if all pieces are small, the largest one stays.
  Index largest = 0;
  for (Index f = 0; f < face_count; ++f) largest = std::max(largest, mesh_.piece_size(f));
  const Index least = std::min(options_.min_component_faces, largest);
  std::vector<bool> turned(mesh_.triangles().size()), against(turned.size());
  for (Index f = 0; f < face_count; ++f) {
    const auto [representative, flipped] = mesh_.piece_of(f);
    turned[f] = flipped != (outward_[representative] < 0);
    against[f] = (shape_.outwardness(mesh_.triangles()[f]) < 0) != turned[f];
  }
  const HangingPatches hanging = find_hanging_patches(mesh_, against, least);
  counts_.turned_patches = hanging.count;
  std::vector<Triangle> kept;
  for (Index f = 0; f < face_count; ++f) {
    if (mesh_.piece_size(f) < least) {
      ++counts_.dropped_faces;
      counts_.dropped_components += mesh_.piece_of(f).first == f;
      continue;
    }
    if (hanging.cut[f]) continue;
    Triangle triangle = mesh_.triangles()[f];
    if (turned[f] != hanging.turned[f]) std::swap(triangle[1], triangle[2]);
    kept.push_back(triangle);
  }
  // They were inserted in the order of their radii, which rounding (a cloud in other units) may change.
  std::sort(kept.begin(), kept.end());
  ExtractedMesh extracted;
  counts_.split_vertices = split_pinched_vertices(kept, shape_.vertices(), extracted.faces, extracted.sources);
  extracted.counts = counts_;
  return extracted;
}

void require_candidates(const Candidates& candidates, Index seeds) {
  const Faces& triangles = candidates.triangles;
  require_indices(triangles, 0, seeds, "candidate triangles");
  require_rows(candidates.counts, triangles.rows(), "counts");
  require_indices(candidates.counts.cast<Index>(), 1, 4, "counts");
  require((triangles.col(0).array() < triangles.col(1).array()).all() &&
              (triangles.col(1).array() < triangles.col(2).array()).all(),
          "the corners of a candidate triangle must ascend");
}

}  // namespace

ExtractedMesh extract_manifold(const CoordinatesRef& coordinates, const PointsRef& normals,
                               const Eigen::Ref<const Eigen::VectorXd>& disk_radii, const Candidates& candidates,
                               const ExtractionOptions& options) {
  require(coordinates.cols() >= 3 && coordinates.rows() == normals.rows() && normals.rows() == disk_radii.size(),
          "coordinates must be (n, d >= 3), normals (n, 3) and radii (n)");
  require_finite(coordinates, "coordinates");
  require_finite(normals, "normals");
  require(disk_radii.allFinite() && (disk_radii.array() > 0).all(), "disk radii must be positive and finite");
  require_candidates(candidates, coordinates.rows());
  require(options.max_fold > 0 && options.max_normal_angle > 0 && options.max_circumradius > 0,
          "the limits of the extraction must be positive");
  Extractor extractor(coordinates, normals, disk_radii, options);
  extractor.insert_candidates(candidates);
  return extractor.finish();
}

}  // namespace hdpea
