// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/points/normal_orientation.hpp"

#include "bindings/bindings.hpp"
#include "hdpea_cpp/points/seams.hpp"

void register_normal_orientation(nb::module_& module) {
  module.def("orient_normals", &hdpea::orient_normals, "points"_a, "normals"_a, "neighbors"_a,
             "known"_a = hdpea::Mask(), ReleaseGil(),
             "Give normals (n, 3) one consistent orientation; signs on entry matter only where they are known (n).");
  module.def("agree_on_signs", &hdpea::agree_on_signs, "points"_a, "normals"_a, "neighbors"_a, "vote"_a = hdpea::kVote,
             ReleaseGil(), "Give each piece of the surface the sides that most of its normals (n, 3) have.");
  module.def(
      "turn_at_seams", &hdpea::turn_at_seams, "points"_a, "normals"_a, "neighbors"_a, ReleaseGil(),
      "Turn what goes on smoothly beyond a line with the opposite normals (n, 3), as where a scan meets itself.");
  module.def("orientation_consistency", &hdpea::orientation_consistency, "points"_a, "normals"_a, "neighbors"_a,
             ReleaseGil(), "Share of neighbours whose signs agree: 1 for oriented normals, 0.5 for random signs.");
}
