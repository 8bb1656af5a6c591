// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/neighbors.hpp"

#include "bindings/bindings.hpp"

void register_neighbors(nb::module_& module) {
  using hdpea::CoordinatesRef;
  using hdpea::Index;
  module.def("nearest_neighbors",
             nb::overload_cast<const CoordinatesRef&, const CoordinatesRef&, Index>(&hdpea::nearest_neighbors),
             "points"_a, "queries"_a, "k"_a, ReleaseGil(),
             "The k nearest of points (n, d) to each query (m, d): (m, k) int64, ties by index, padded with -1.");
  module.def("nearest_neighbors", nb::overload_cast<const CoordinatesRef&, Index>(&hdpea::nearest_neighbors),
             "points"_a, "k"_a, ReleaseGil(),
             "The k nearest other points of each point (n, d): (n, k) int64, ties by index, padded with -1.");
}
