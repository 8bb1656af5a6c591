# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the particles."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.options.checked import Checked, option
from hdpea.options.meshing import POINTS_PER_VERTEX

POINTS_PER_PARTICLE = 3
"""Points per particle where the mesh is simplified: with fewer particles, what is thinner than they are apart tears."""

POINTS_PER_ROUGH_PARTICLE = 4
"""The same where points were denoised."""

ENOUGH_PARTICLES, ENOUGH_PER_VERTEX = 20_000, 2
"""Most particles, and most for each vertex wanted, whichever is larger, however many points there are."""

WORTH_SIMPLIFYING = 1.2
"""Fewest particles per vertex at which simplifying a finer mesh is more accurate; below, it is only less even."""

ITERATIONS, ITERATIONS_OF_MANY = 100, 20
"""Steps of the particles: where each becomes a vertex, and where their mesh is simplified and evened out afterwards,
so that they need only be even enough for their cells to meet."""


@dataclass(frozen=True)
class ParticleOptions(Checked):
    """How particles are spread (``hdpea.mesh.particles``)."""

    particles: int | None = option(
        None,
        "particles to spread; their mesh is simplified where fewer vertices are wanted; default: one for every "
        f"{POINTS_PER_PARTICLE} points, at most {ENOUGH_PARTICLES:,} or {ENOUGH_PER_VERTEX} for each vertex; one for "
        f"every {POINTS_PER_ROUGH_PARTICLE} where points were denoised, and for every {POINTS_PER_VERTEX} where most "
        "normals were estimated, or with an error or watertight, unless more vertices are wanted; as many as vertices "
        "where that is hardly more",
        minimum=4,
    )
    iterations: int | None = option(
        None,
        f"steps of the particles' energy descent; default: {ITERATIONS}, or {ITERATIONS_OF_MANY} where there are more "
        "particles than vertices are wanted",
        minimum=0,
        maximum=100_000,
    )
    seed: int = option(0, "seed of everything random; the same seed gives the same bytes", minimum=0)
