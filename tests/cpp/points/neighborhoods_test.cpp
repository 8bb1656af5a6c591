// SPDX-License-Identifier: GPL-3.0-or-later
// Every function of points, normals and neighbours checks all three before it uses any.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/points/curvature.hpp"
#include "hdpea_cpp/points/jet_fitting.hpp"
#include "hdpea_cpp/points/moving_least_squares.hpp"
#include "hdpea_cpp/points/neighbors.hpp"
#include "hdpea_cpp/points/normal_orientation.hpp"
#include "hdpea_cpp/points/normals.hpp"
#include "hdpea_cpp/points/seams.hpp"
#include "hdpea_cpp/points/sheets.hpp"
#include "hdpea_cpp/points/tangent_basis.hpp"
#include "helpers/clouds.hpp"

namespace hdpea {
namespace {

struct Function {
  std::string name;
  std::function<void(const Points& points, const Points& normals, const Neighbors& neighbors)> call;
};

const Function kFunctions[] = {
    {"agree_on_signs", [](auto&... given) { agree_on_signs(given...); }},
    {"estimate_curvature", [](auto&... given) { estimate_curvature(given..., 0.5); }},
    {"fit_jets", [](auto&... given) { fit_jets(given...); }},
    {"moving_least_squares", [](auto& p, auto& n, auto& near) { moving_least_squares(p, n, p, near); }},
    {"orient_normals", [](auto&... given) { orient_normals(given...); }},
    {"orientation_consistency", [](auto&... given) { orientation_consistency(given...); }},
    {"sheet_neighbors", [](auto&... given) { sheet_neighbors(given...); }},
    {"tangent_bases", [](auto&... given) { tangent_bases(given...); }},
    {"turn_at_seams", [](auto&... given) { turn_at_seams(given...); }},
};

class Neighborhoods : public testing::TestWithParam<Function> {
 protected:
  void call() const { GetParam().call(sphere.points, sphere.normals, neighbors); }

  clouds::Cloud sphere = clouds::sphere(50);
  Neighbors neighbors = nearest_neighbors(sphere.points, 12);
};

TEST_P(Neighborhoods, MayBePaddedOrEmpty) {
  EXPECT_NO_THROW(call());
  neighbors.row(7).setConstant(-1);
  neighbors(8, 3) = -1;
  EXPECT_NO_THROW(call());
  neighbors.resize(50, 0);
  EXPECT_NO_THROW(call());
  sphere = {Points(0, 3), Points(0, 3)};
  neighbors.resize(0, 12);
  EXPECT_NO_THROW(call());
}

TEST_P(Neighborhoods, MayLieInOnePlace) {
  sphere.points.setZero();
  EXPECT_NO_THROW(call());
}

TEST_P(Neighborhoods, HoldNoPointThatDoesNotExist) {
  for (Index bad : {Index{50}, Index{1000000}, Index{1} << 40, Index{-2}}) {
    neighbors(49, 11) = bad;
    EXPECT_THROW(call(), InvalidArgument) << bad;
  }
}

TEST_P(Neighborhoods, AreFinite) {
  for (double bad : {std::nan(""), HUGE_VAL, 1e160}) {
    sphere.points(49, 2) = bad;
    EXPECT_THROW(call(), InvalidArgument) << bad;
  }
  sphere.points(49, 2) = 0;
  sphere.normals(49, 2) = std::nan("");
  EXPECT_THROW(call(), InvalidArgument);
}

TEST_P(Neighborhoods, HaveARowForEachPoint) {
  neighbors.conservativeResize(49, 12);
  EXPECT_THROW(call(), InvalidArgument);
  neighbors = Neighbors::Constant(50, 12, 0);
  sphere.normals.conservativeResize(49, 3);
  EXPECT_THROW(call(), InvalidArgument);
}

INSTANTIATE_TEST_SUITE_P(Functions, Neighborhoods, testing::ValuesIn(kFunctions),
                         [](const auto& each) { return each.param.name; });

TEST(BlendedNormals, RefuseNeighborsThatDoNotExist) {
  const auto sphere = clouds::sphere(10);
  EXPECT_THROW(blended_normals(sphere.normals, Neighbors::Constant(10, 4, 10)), InvalidArgument);
  EXPECT_THROW(blended_normals(sphere.normals, Neighbors::Constant(9, 4, 0)), InvalidArgument);
  EXPECT_THROW(blended_normals(sphere.normals, Neighbors::Constant(10, 4, 0), -1), InvalidArgument);
  EXPECT_TRUE(blended_normals(sphere.normals, Neighbors::Constant(10, 4, -1)).isApprox(sphere.normals));
}

}  // namespace
}  // namespace hdpea
