// SPDX-License-Identifier: GPL-3.0-or-later
// Every function of vertices and faces checks both before it uses either.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/mesh/gap_closing.hpp"
#include "hdpea_cpp/mesh/hole_filling.hpp"
#include "hdpea_cpp/mesh/mesh_check.hpp"
#include "hdpea_cpp/mesh/reaching.hpp"
#include "hdpea_cpp/mesh/refinement.hpp"
#include "hdpea_cpp/mesh/remeshing.hpp"
#include "hdpea_cpp/mesh/self_intersections.hpp"
#include "hdpea_cpp/mesh/simplification.hpp"
#include "hdpea_cpp/mesh/surface_distance.hpp"
#include "helpers/shapes.hpp"

namespace hdpea {
namespace {

struct Function {
  std::string name;
  std::function<void(const Points& vertices, const Faces& faces)> call;
};

const Function kFunctions[] = {
    {"check_mesh", [](auto&... mesh) { check_mesh(mesh...); }},
    {"close_gaps",
     [](auto& vertices, auto& faces) { close_gaps(vertices, faces, Points::Zero(vertices.rows(), 3), 1); }},
    {"closest_surface_points", [](auto&... mesh) { closest_surface_points(mesh..., Points::Zero(1, 3)); }},
    {"count_self_intersections", [](auto&... mesh) { count_self_intersections(mesh...); }},
    {"fill_holes", [](auto&... mesh) { fill_holes(mesh..., 1); }},
    {"reach_points", [](auto&... mesh) { reach_points(mesh..., Points::Zero(9, 3), Points::Constant(9, 3, 0.5), 1); }},
    {"refine_vertices",
     [](auto&... mesh) { refine_vertices(mesh..., Points::Zero(9, 3), Points::Constant(9, 3, 0.5), {}); }},
    {"remesh_isotropically", [](auto&... mesh) { remesh_isotropically(mesh..., {.edge_length = 0.4}); }},
    {"simplify_mesh",
     [](auto& vertices, auto& faces) {
       simplify_mesh(vertices, vertices, faces, Points(0, 3), Points(0, 3), {.vertices = 9}, {});
     }},
};

class IndexedMeshes : public testing::TestWithParam<Function> {
 protected:
  void call() const { GetParam().call(mesh.vertices, mesh.faces); }

  shapes::Mesh mesh = shapes::grid(3, 3);
};

TEST_P(IndexedMeshes, MayHaveVerticesWithoutAFace) {
  EXPECT_NO_THROW(call());
  mesh.vertices.conservativeResize(17, 3);
  mesh.vertices.row(16) << 5, 5, 5;
  EXPECT_NO_THROW(call());
}

TEST_P(IndexedMeshes, HaveNoVertexThatDoesNotExist) {
  for (Index bad : {Index{16}, Index{1000000}, Index{1} << 40, Index{-1}}) {
    mesh.faces(17, 2) = bad;
    EXPECT_THROW(call(), InvalidArgument) << bad;
  }
  mesh.vertices.resize(0, 3);
  EXPECT_THROW(call(), InvalidArgument);
}

TEST_P(IndexedMeshes, AreFinite) {
  for (double bad : {std::nan(""), HUGE_VAL, 1e160}) {
    mesh.vertices(15, 2) = bad;
    EXPECT_THROW(call(), InvalidArgument) << bad;
  }
}

INSTANTIATE_TEST_SUITE_P(Functions, IndexedMeshes, testing::ValuesIn(kFunctions),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace hdpea
