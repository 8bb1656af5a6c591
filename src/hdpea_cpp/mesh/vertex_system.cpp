// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/vertex_system.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

/// Each step leaves about half of the error, or less; this many are enough for 1e-12 of what it was at first.
constexpr int kMostSteps = 500;
constexpr double kTolerance = 1e-12;

double dot(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

VertexSystem::VertexSystem(Index vertices, const FacesRef& faces)
    : starts_(static_cast<std::size_t>(vertices) + 1), places_(static_cast<std::size_t>(faces.rows())) {
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(vertices));
  for (Index v = 0; v < vertices; ++v) rows[v].push_back(v);
  const auto place = [&](Index v, Index w) { return std::find(rows[v].begin(), rows[v].end(), w) - rows[v].begin(); };
  for (Index f = 0; f < faces.rows(); ++f) {
    for (Index v : faces.row(f)) {
      for (Index w : faces.row(f)) {
        if (place(v, w) == static_cast<Index>(rows[v].size())) rows[v].push_back(w);
      }
    }
  }
  for (Index v = 0; v < vertices; ++v) starts_[v + 1] = starts_[v] + static_cast<Index>(rows[v].size());
  for (Index f = 0; f < faces.rows(); ++f) {
    for (int corners = 0; corners < 9; ++corners) {
      const Index v = faces(f, corners / 3);
      places_[f][corners] = starts_[v] + place(v, faces(f, corners % 3));
    }
  }
  columns_.reserve(starts_.back());
  for (const auto& row : rows) columns_.insert(columns_.end(), row.begin(), row.end());
  blocks_.assign(columns_.size(), Block::Zero());
}

void VertexSystem::add(Index face, const Eigen::RowVector3d& weights, const Eigen::RowVector3d& direction) {
  const Block square = direction.transpose() * direction;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) blocks_[places_[face][3 * i + j]] += weights(i) * weights(j) * square;
  }
}

void VertexSystem::add_to_diagonal(double value) {
  for (std::size_t v = 0; v + 1 < starts_.size(); ++v) blocks_[starts_[v]].diagonal().array() += value;
}

Points VertexSystem::times(const Points& vectors) const {
  Points product(vectors.rows(), 3);
  parallel_for(vectors.rows(), [&](Index v) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Index at = starts_[v]; at < starts_[v + 1]; ++at) {
      sum.noalias() += blocks_[at] * vectors.row(columns_[at]).transpose();
    }
    product.row(v) = sum.transpose();
  });
  return product;
}

Points VertexSystem::solve(const Points& right, const Points& start, const MaskRef& fixed) const {
  // Zero for a fixed vertex, which no direction of the search moves then.
  std::vector<Block> inverses(static_cast<std::size_t>(start.rows()), Block::Zero());
  parallel_for(start.rows(), [&](Index v) {
    if (fixed.size() == 0 || !fixed(v)) inverses[v] = blocks_[starts_[v]].inverse();
  });
  const auto preconditioned = [&](const Points& vectors) {
    Points result(vectors.rows(), 3);
    parallel_for(vectors.rows(), [&](Index v) { result.row(v) = vectors.row(v) * inverses[v]; });
    return result;
  };
  Points solution = start, residual = right - times(start), direction = preconditioned(residual);
  double size = dot(residual, direction);
  const double enough = kTolerance * kTolerance * size;
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    const Points image = times(direction);
    const double length = size / dot(direction, image);
    solution += length * direction;
    residual -= length * image;
    const Points next = preconditioned(residual);
    const double next_size = dot(residual, next);
    direction = next + next_size / size * direction;
    size = next_size;
  }
  if (!std::isfinite(size) || !solution.allFinite()) throw CannotReconstruct("the fit's linear system has no solution");
  return solution;
}

}  // namespace hdpea
