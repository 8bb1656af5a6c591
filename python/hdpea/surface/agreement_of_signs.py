# SPDX-License-Identifier: GPL-3.0-or-later
"""Signs by the method after which most neighbours agree, decided on a part of the points if there are many."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hdpea import _core
from hdpea.frontend.roughness import Roughness
from hdpea.geometry.thinning import farthest_rows
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.sign_methods import by_spanning_tree, by_winding_number
from hdpea.surface.signs import Orientation, SignEvidence, Vectors

DECIDING = 50_000
"""Most points that the sides are decided on; of more, the others follow the nearest of these.

They are farthest points, and lie as evenly and twice as near to each other as the particles of most meshes."""

FOLLOWED = 4
"""Nearest deciding points of which the one whose plane is most nearly a point's own is followed: so a wall has two."""

FAVOURED, CHANCE = 1.5, 0.0003
"""How many times the disagreement of the spanning tree that of the winding number may be, and what is added to it.

A tree joins those that agree most, so that a whole part may be on the wrong side and few neighbours disagree. Rings
and views of twelve training meshes have 2.1 % of their points on the wrong side instead of 3.0 %; 73 scans with holes
of 25 others 4.7 % either way."""


def by_agreement(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    """Orient by the winding number or the spanning tree, whichever neighbours agree with more."""
    decide = _of_deciding_points if len(points) > DECIDING else _of_all
    return decide(points, directions, evidence, progress)


def _of_all(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    candidates = {
        "wnnc": by_winding_number(points, directions, evidence, progress),
        "mst": by_spanning_tree(points, directions, evidence),
    }
    agreed = {
        method: _core.orientation_consistency(points, normals, evidence.neighbors)
        for method, normals in candidates.items()
    }
    # Noise and thin walls mislead the spanning tree, large openings the winding number: then neighbours disagree.
    most = FAVOURED * (1 - agreed["mst"]) + CHANCE
    best, other = ("wnnc", "mst") if 1 - agreed["wnnc"] <= most else ("mst", "wnnc")
    why = f"{agreed[best]:.2%} of neighbours agree on the side, by {other} {agreed[other]:.2%}"
    # What was seen through an opening touches nothing that it could agree with.
    normals = _core.turn_contrary_pieces(points, candidates[best], evidence.neighbors)
    return Orientation(normals, best, why)


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
