// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/self_intersections.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <tbb/parallel_reduce.h>

#include <functional>
#include <utility>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"

namespace hdpea {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;
using FacePair = std::pair<Index, Index>;

class Soup {
 public:
  Soup(const PointsRef& vertices, const FacesRef& faces) : vertices_(vertices), faces_(faces) {}

  Kernel::Triangle_3 triangle(Index f) const { return {corner(f, 0), corner(f, 1), corner(f, 2)}; }

  /// Pairs whose bounding boxes meet, degenerate faces left out.
  std::vector<FacePair> candidates() const {
    std::vector<Box> boxes;
    for (Index f = 0; f < faces_.rows(); ++f) {
      const Kernel::Triangle_3 face = triangle(f);
      if (!face.is_degenerate()) boxes.emplace_back(face.bbox(), f);
    }
    std::vector<FacePair> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                  [&](const Box& a, const Box& b) { pairs.emplace_back(a.info(), b.info()); });
    return pairs;
  }

  bool intersect(Index f, Index g) const {
    int shared = 0, i = 0, j = 0;
    bool of_f[3] = {}, of_g[3] = {};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        if (faces_(f, a) != faces_(g, b)) continue;
        ++shared;
        of_f[i = a] = of_g[j = b] = true;
      }
    }
    if (shared == 0) return CGAL::do_intersect(triangle(f), triangle(g));
    if (shared == 1) {
      return CGAL::do_intersect(triangle(f), opposite_edge(g, j)) ||
             CGAL::do_intersect(triangle(g), opposite_edge(f, i));
    }
    if (shared == 3) return true;
    i = !of_f[0] ? 0 : !of_f[1] ? 1 : 2;
    j = !of_g[0] ? 0 : !of_g[1] ? 1 : 2;
    return folded(corner(f, i + 1), corner(f, i + 2), corner(f, i), corner(g, j));
  }

 private:
  Kernel::Point_3 corner(Index f, int i) const {
    const auto& p = vertices_.row(faces_(f, i % 3));
    return {p(0), p(1), p(2)};
  }
  Kernel::Segment_3 opposite_edge(Index f, int i) const { return {corner(f, i + 1), corner(f, i + 2)}; }

  /// Whether the triangles a b c and a b d lie in one plane and on one side of a b.
  static bool folded(const Kernel::Point_3& a, const Kernel::Point_3& b, const Kernel::Point_3& c,
                     const Kernel::Point_3& d) {
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  const PointsRef& vertices_;
  const FacesRef& faces_;
};

}  // namespace

Index count_self_intersections(const PointsRef& vertices, const FacesRef& faces) {
  require_mesh(vertices, faces);
  const Soup soup(vertices, faces);
  const std::vector<FacePair> pairs = soup.candidates();
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, pairs.size(), 256), Index{0},
      [&](const Range& range, Index count) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          count += soup.intersect(pairs[i].first, pairs[i].second);
        }
        return count;
      },
      std::plus<Index>());
}

}  // namespace hdpea
