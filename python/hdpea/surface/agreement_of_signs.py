# SPDX-License-Identifier: GPL-3.0-or-later
"""Signs of points of which nobody says where they were seen from, decided on a part of them if there are many."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hdpea import _core
from hdpea.frontend.roughness import Roughness
from hdpea.geometry.thinning import farthest_rows
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.sign_methods import by_winding_number
from hdpea.surface.signs import Orientation, SignEvidence, Vectors, cosines

DECIDING = 50_000
"""Most points that the sides are decided on; of more, the others follow the nearest of these.

They are farthest points, and lie as evenly and twice as near to each other as the particles of most meshes."""

FOLLOWED = 4
"""Nearest deciding points of which the one whose plane is most nearly a point's own is followed: so a wall has two."""


def by_agreement(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    """Orient by the winding number, and by what neighbours agree on."""
    decide = _of_deciding_points if len(points) > DECIDING else _of_all
    return decide(points, directions, evidence, progress)


def _of_all(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    signed = by_winding_number(points, directions, evidence, progress)
    agreed = _core.orientation_consistency(points, signed, evidence.neighbors)
    normals = _core.turn_at_seams(points, signed, evidence.neighbors)
    seams = bool((cosines(normals, signed) < 0).any())
    return Orientation(normals, "wnnc", f"{agreed:.2%} of neighbours agree on the side", seams=seams)


def _of_deciding_points(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    """Orient the points that lie farthest from each other, and all others as these are."""
    deciding = np.sort(farthest_rows(points, DECIDING))
    few = np.ascontiguousarray(points[deciding])
    # Their spacing is wider than that of all, so that in spacings they are less rough.
    thinner = Roughness(
        evidence.roughness.deviation * float(np.sqrt(DECIDING / len(points))), evidence.roughness.like_noise
    )
    known = replace(evidence.of_rows(deciding, few), roughness=thinner)
    decided = _of_all(few, np.ascontiguousarray(directions[deciding]), known, progress)
    return replace(decided, normals=_followed(points, directions, few, decided.normals))


def _followed(points: Vectors, directions: Vectors, deciding: Vectors, normals: Vectors) -> Vectors:
    """Turn the directions (n, 3) as the normals (m, 3) of the deciding points (m, 3) near them that are most alike."""
    nearest = _core.nearest_neighbors(deciding, points, FOLLOWED)
    alike = np.einsum("nc,nkc->nk", directions, normals[nearest])
    best = abs(alike).argmax(axis=1)
    return np.where(alike[np.arange(len(points)), best] < 0, -1, 1)[:, None] * directions
