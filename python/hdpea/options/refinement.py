# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the fit of the mesh to the points."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.options.checked import Checked, option


@dataclass(frozen=True)
class RefinementOptions(Checked):
    """How the mesh is fitted to the points afterwards (``hdpea.mesh.refinement``)."""

    refine: bool = option(True, "fit the vertices to the points by least squares")
    rounds: int = option(2, "rounds of projection and fitting", minimum=0, maximum=1_000)
