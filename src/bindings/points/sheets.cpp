// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/sheets.hpp"

#include "bindings/bindings.hpp"

void register_sheets(nb::module_& module) {
  // Options and counts are for the core's own tests: nobody sets them from Python.
  module.def(
      "sheet_neighbors",
      [](const hdpea::PointsRef& points, const hdpea::PointsRef& normals, const hdpea::NeighborsRef& neighbors) {
        return hdpea::sheet_neighbors(points, normals, neighbors);
      },
      "points"_a, "normals"_a, "neighbors"_a, ReleaseGil(), "Keep the neighbours on the same sheet; pad with -1.");
  module.def(
      "blended_normals",
      [](const hdpea::PointsRef& normals, const hdpea::NeighborsRef& sheet_neighbors) {
        return hdpea::blended_normals(normals, sheet_neighbors);
      },
      "normals"_a, "sheet_neighbors"_a, ReleaseGil(),
      "The mean normal of each point and its nearest neighbours of the sheet.");
}
