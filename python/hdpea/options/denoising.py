# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the denoising."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.options.checked import Checked, option

ROUGH = 0.15
"""Roughness, in spacings of the points, from which moving least squares gains more than it blurs."""

FEWEST_FITTED, MOST_FITTED = 80, 320
"""Fewest and most neighbours that moving least squares fits, depending on the roughness: more of them remove more
noise, and more detail."""


@dataclass(frozen=True)
class DenoisingOptions(Checked):
    """How the points are denoised (``hdpea.surface.denoising``)."""

    denoise: str = option(
        "auto",
        "mls: first move each point onto the quadric that fits its neighbours (moving least squares); auto: if the "
        f"points are more than {ROUGH:g} of their spacing off a smooth surface",
        choices=("auto", "none", "mls"),
    )
    denoise_neighbors: int | None = option(
        None,
        f"mls: nearest points that it is fitted to; default: from {FEWEST_FITTED} to {MOST_FITTED}, "
        "by how rough they are",
        minimum=6,
    )
