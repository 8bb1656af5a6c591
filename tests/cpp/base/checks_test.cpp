// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hdpea {
namespace {

TEST(Checks, FiniteIsWhatHasASquareAsWell) {
  EXPECT_NO_THROW(require_finite(Points(0, 3), "points"));
  EXPECT_NO_THROW(require_finite(Points::Constant(4, 3, -1e150), "points"));
  for (double bad : {std::nan(""), -std::numeric_limits<double>::infinity(), 1e151, -1e200}) {
    Points points = Points::Zero(4, 3);
    points(3, 2) = bad;
    EXPECT_THROW(require_finite(points, "points"), InvalidArgument) << bad;
  }
}

TEST(Checks, IndicesLieInAHalfOpenRange) {
  EXPECT_NO_THROW(require_indices(Faces(0, 3), 0, 0, "faces"));
  EXPECT_NO_THROW(require_indices(Faces::Constant(2, 3, 4), 0, 5, "faces"));
  EXPECT_THROW(require_indices(Faces::Constant(2, 3, 5), 0, 5, "faces"), InvalidArgument);
  EXPECT_THROW(require_indices(Faces::Constant(2, 3, -1), 0, 5, "faces"), InvalidArgument);
  EXPECT_THROW(require_indices(Faces::Constant(2, 3, 0), 0, 0, "faces"), InvalidArgument);
}

TEST(Checks, NeighborsMayBePadded) {
  EXPECT_NO_THROW(require_neighbors(Neighbors::Constant(5, 2, -1), 5));
  EXPECT_THROW(require_neighbors(Neighbors::Constant(5, 2, -2), 5), InvalidArgument);
  EXPECT_THROW(require_neighbors(Neighbors::Constant(5, 2, 5), 5), InvalidArgument);
  EXPECT_THROW(require_neighbors(Neighbors::Constant(4, 2, 0), 5), InvalidArgument);
}

TEST(Checks, TellWhatIsWrong) {
  try {
    require_indices(Faces::Constant(1, 3, 7), 0, 5, "faces");
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "faces must lie in [0, 5), not 7");
  }
  try {
    require_rows(Points(3, 3), 4, "normals");
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "normals must have 4 rows, not 3");
  }
}

}  // namespace
}  // namespace hdpea
