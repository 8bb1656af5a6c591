# SPDX-License-Identifier: GPL-3.0-or-later
"""How many vertices and particles all tiles make together, decided as in one piece from what each tile has found."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from hdpea.errors import CannotReconstruct
from hdpea.mesh.budget import particles_wanted
from hdpea.mesh.noise import PER_VERTEX, within_measured_noise
from hdpea.options.points_shown import PointsShown
from hdpea.tiling.work import Work

Facts = list[dict[str, Any]]
"""What each tile has found of its points (``hdpea.tiling.preparing``)."""


def numbers_of(work: Work) -> dict[str, Any]:
    """Return what all tiles go by: those of ``Agreed``, and what was chosen for them.

    Raises
    ------
    CannotReconstruct
        If no tile has a point.
    UsageError
        If more vertices or particles are asked for than there are points.
    """
    facts = [work.folder.facts("prepared", tile) for tile in range(work.plan.tiles)]
    points, count = sum(each["points"] for each in facts), round(sum(each["shown"] for each in facts))
    if points == 0:
        raise CannotReconstruct("No point lies on a surface.")
    options, noise_choices = within_measured_noise(work.options, _noise(facts), lambda p: _missed(facts, p), count)
    # As in one piece: what noise hides, more particles do not show.
    exact = _most(facts, "exact") and not noise_choices
    shown = PointsShown(count, exact, _most(facts, "denoised"))
    particles, count_choices = particles_wanted(options, points, shown)
    resolution = options.resolution_of(count)
    return {
        "spacing": float(np.sqrt(sum(each["area"] for each in facts) / resolution)),
        "resolution": resolution,
        "vertices": options.vertices_of(count),
        "particles": particles,
        "per_vertex": points / resolution,
        "points": points,
        "exact": exact,
        "computed_sides": any(each["computed_sides"] for each in facts),
        "choices": [asdict(choice) for choice in (*noise_choices, *count_choices)],
    }


def _most(facts: Facts, name: str) -> bool:
    """Return whether that is so of most points."""
    return bool(2 * sum(each["points"] for each in facts if each[name]) > sum(each["points"] for each in facts))


def _noise(facts: Facts) -> float:
    """Return the noise, in spacings, that half of the points have at least, by what their tiles have.

    A few rough tiles do not make a clean cloud a noisy one, as they do not in one piece.
    """
    noise, points = (np.array([each[name] for each in facts]) for name in ("noise", "points"))
    order = np.argsort(-noise, kind="stable")
    half = int(np.searchsorted(2 * points[order].cumsum(), points.sum()))
    return float(noise[order][half])


def _missed(facts: Facts, per_vertex: int) -> float | None:
    """Return what planes of so many points per vertex miss in all tiles that are noisy; None if none knows."""
    number = PER_VERTEX.index(per_vertex)
    known = [(each["missed_by_planes"][number], each["points"]) for each in facts if each["missed_by_planes"]]
    told = [(variance, points) for variance, points in known if variance is not None]
    if not told:
        return None
    variances, weights = zip(*told, strict=True)
    return float(np.average(variances, weights=weights))
