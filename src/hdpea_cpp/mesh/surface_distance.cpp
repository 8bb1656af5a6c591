// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/mesh/surface_distance.hpp"

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hdpea_cpp/base/checks.hpp"
#include "hdpea_cpp/base/errors.hpp"
#include "hdpea_cpp/base/parallel.hpp"
#include "hdpea_cpp/points/neighbors.hpp"

namespace hdpea {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Vector = Eigen::RowVector3d;

struct Face {
  Index index;
  Kernel::Triangle_3 triangle;
};

/// A face as CGAL's tree sees it; the tree makes it from an iterator.
class Primitive {
 public:
  using Id = Index;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Triangle_3;

  explicit Primitive(std::vector<Face>::const_iterator face) : face_(*face) {}
  Id id() const { return face_.index; }
  const Datum& datum() const { return face_.triangle; }
  const Point& reference_point() const { return face_.triangle[0]; }

 private:
  Face face_;
};

#if CGAL_VERSION_NR >= 1060000000
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif

/// Keeps the closest of the points offered on one triangle.
class ClosestOfTriangle {
 public:
  ClosestOfTriangle(const Vector& a, const Vector& b, const Vector& c, const Vector& query)
      : corners_{a, b, c}, query_(query) {
    for (int i = 0; i < 3; ++i) offer_edge(i, (i + 1) % 3);
    offer_inside();
  }
  double distance() const { return std::sqrt(best_); }
  const Vector& barycentric() const { return barycentric_; }
  Vector position() const {
    return barycentric_[0] * corners_[0] + barycentric_[1] * corners_[1] + barycentric_[2] * corners_[2];
  }

 private:
  void offer(const Vector& weights) {
    const Vector point = weights[0] * corners_[0] + weights[1] * corners_[1] + weights[2] * corners_[2];
    const double distance = (point - query_).squaredNorm();
    if (distance >= best_) return;
    best_ = distance;
    barycentric_ = weights;
  }

  void offer_edge(int i, int j) {
    const Vector edge = corners_[j] - corners_[i];
    const double length = edge.squaredNorm();
    const double t = length > 0 ? std::clamp((query_ - corners_[i]).dot(edge) / length, 0.0, 1.0) : 0;
    Vector weights = Vector::Zero();
    weights[i] = 1 - t;
    weights[j] = t;
    offer(weights);
  }

  /// The edges are offered as well, so a needle whose weights are lost to rounding does no harm.
  void offer_inside() {
    const Vector ab = corners_[1] - corners_[0], ac = corners_[2] - corners_[0], ap = query_ - corners_[0];
    const Vector normal = ab.cross(ac);
    const double b = normal.dot(ap.cross(ac)) / normal.squaredNorm();
    const double c = normal.dot(ab.cross(ap)) / normal.squaredNorm();
    if (b >= 0 && c >= 0 && b + c <= 1) offer({1 - b - c, b, c});
  }

  Vector corners_[3];
  const Vector& query_;
  double best_ = std::numeric_limits<double>::infinity();
  Vector barycentric_ = Vector::Zero();
};

class Surface {
 public:
  Surface(const PointsRef& vertices, const FacesRef& faces)
      : vertices_(vertices), faces_(faces), extent_(vertices.cwiseAbs().maxCoeff()), centroids_(faces.rows(), 3) {
    const auto point = [&](Index v) { return Kernel::Point_3(vertices(v, 0), vertices(v, 1), vertices(v, 2)); };
    std::vector<Face> all;
    all.reserve(faces.rows());
    for (Index f = 0; f < faces.rows(); ++f) {
      const Index a = faces(f, 0), b = faces(f, 1), c = faces(f, 2);
      all.push_back({f, {point(a), point(b), point(c)}});
      centroids_.row(f) = (vertices.row(a) + vertices.row(b) + vertices.row(c)) / 3;
    }
    tree_.insert(all.cbegin(), all.cend());
    // The tree builds itself at the first query otherwise, which is not safe from several threads.
    tree_.build();
  }

  const Coordinates& centroids() const { return centroids_; }
  /// The largest coordinate, which rounding goes by.
  double extent() const { return extent_; }
  const Tree& tree() const { return tree_; }

  ClosestOfTriangle closest(Index f, const Vector& query) const {
    return {vertices_.row(faces_(f, 0)), vertices_.row(faces_(f, 1)), vertices_.row(faces_(f, 2)), query};
  }

 private:
  const PointsRef& vertices_;
  const FacesRef& faces_;
  double extent_;
  Coordinates centroids_;
  Tree tree_;
};

/// CGAL's traversal, with our own distance: CGAL's asks for faces with area and leaves ties to the tree.
///
/// The faces at an edge or a corner are equally far from all that is nearest to it, but for rounding, which is another
/// in other units: distances that differ by no more count as equal, and the face of lowest index is the nearest.
class Traversal {
 public:
  Traversal(const Surface& surface, const Vector& query, Index hint)
      : surface_(surface), query_(query), face_(hint), distance_(surface.closest(hint, query).distance()) {}

  bool go_further() const { return true; }

  void intersection(const Vector&, const Primitive& primitive) {
    const double distance = surface_.closest(primitive.id(), query_).distance();
    if (distance > farthest_equal(distance_)) return;
    if (farthest_equal(distance) < distance_ || primitive.id() < face_) face_ = primitive.id();
    distance_ = std::min(distance, distance_);
  }

  /// A face as far as the best must be seen, for its index may be lower.
  template <class Node>
  bool do_intersect(const Vector&, const Node& node) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double gap = std::max({node.bbox().min(c) - query_[c], query_[c] - node.bbox().max(c), 0.0});
      sum += gap * gap;
    }
    return sum <= std::pow(farthest_equal(distance_), 2);
  }

  Index face() const { return face_; }

 private:
  double farthest_equal(double distance) const {
    constexpr double relative = 1e-9, of_coordinates = 1e-14;
    return (1 + relative) * distance + of_coordinates * surface_.extent();
  }

  const Surface& surface_;
  const Vector& query_;
  Index face_;
  double distance_;
};

}  // namespace

SurfacePoints closest_surface_points(const PointsRef& vertices, const FacesRef& faces, const PointsRef& queries) {
  require(faces.rows() >= 1, "the mesh has no face");
  require_mesh(vertices, faces);
  require_finite(vertices, "vertices", kLargestToTheFourth);
  require_finite(queries, "queries", kLargestToTheFourth);
  const Surface surface(vertices, faces);
  const Neighbors hints = nearest_neighbors(surface.centroids(), queries, 1);
  const Index count = queries.rows();
  SurfacePoints found{Eigen::VectorXd(count), Eigen::Vector<Index, Eigen::Dynamic>(count), Points(count, 3),
                      Points(count, 3)};
  parallel_for(count, [&](Index i) {
    const Vector query = queries.row(i);
    Traversal traversal(surface, query, hints(i, 0));
    surface.tree().traversal(query, traversal);
    const ClosestOfTriangle closest = surface.closest(traversal.face(), query);
    found.distance(i) = closest.distance();
    found.face(i) = traversal.face();
    found.barycentric.row(i) = closest.barycentric();
    found.position.row(i) = closest.position();
  });
  return found;
}

}  // namespace hdpea
