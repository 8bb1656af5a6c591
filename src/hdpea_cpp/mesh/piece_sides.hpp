// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hdpea_cpp/base/types.hpp"

namespace hdpea {

/// A mesh whose closed pieces face out.
struct FacedMesh {
  Faces faces;          ///< as given, those of turned pieces with two corners exchanged
  Index turned = 0;     ///< pieces that were inside out, or face down
  Index within = 0;     ///< pieces as good as closed that lie within another one, face inwards, and were left so
  double sideless = 0;  ///< share of the area in pieces so open that nothing is inside or outside of them
};

/// Turns closed pieces of negative volume, and open ones if all lies flat and faces down.
///
/// A piece within another one that is closed, but for small gaps, is left as it is: it may be the wall of a cavity,
/// which faces into that; what lies in an open one is a thing in a bowl. The side of an open piece is a guess, but
/// floors, tables and land are seen from above; of a thin plate's two sides, one does face down. Without an inside are
/// those whose boundary spans more than a quarter of their area: a sphere that lacks its foot has one, half a sphere
/// has none.
///
/// @param vertices  (v, 3), finite
/// @param faces     (f, 3) manifold and oriented, no vertex in two pieces that do not share an edge
FacedMesh face_outwards(const PointsRef& vertices, const FacesRef& faces);

}  // namespace hdpea
