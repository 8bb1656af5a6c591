// SPDX-License-Identifier: GPL-3.0-or-later
// For sources that work on a mesh with CGAL, and headers of theirs; not installed.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The mesh of vertices (v, 3) and faces (f, 3), which are edge-manifold and consistently oriented.
///
/// A pinched vertex, of which a Surface_mesh has none, becomes a vertex for each of its fans.
SurfaceMesh to_cgal(const PointsRef& vertices, const FacesRef& faces);

/// Vertices and faces of a mesh in its own order; removed ones are purged from it.
TriangleMesh from_cgal(SurfaceMesh& mesh);

}  // namespace hdpea
