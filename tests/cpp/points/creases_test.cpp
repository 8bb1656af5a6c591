// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/creases.hpp"

#include <gtest/gtest.h>

#include "hdpea_cpp/base/errors.hpp"

namespace hdpea {
namespace {

TEST(Creases, RefusesTooFewNeighborsAndNormalsOfOtherPoints) {
  const Points points = Points::Random(20, 3);
  CreaseOptions options;
  options.neighbors = 11;
  EXPECT_THROW(find_creases(points, points, options), InvalidArgument);
  EXPECT_THROW(find_creases(points, points.topRows(19)), InvalidArgument);
}

TEST(Creases, OfAFlatGridAreNone) {
  Points points(400, 3), normals(400, 3);
  for (Index i = 0; i < points.rows(); ++i) {
    points.row(i) << double(i % 20), double(i / 20), 0;
    normals.row(i) << 0, 0, 1;
  }
  const Creases creases = find_creases(points, normals);
  EXPECT_TRUE(creases.samples.empty());
  EXPECT_TRUE(creases.corners.empty());
}

}  // namespace
}  // namespace hdpea
