# SPDX-License-Identifier: GPL-3.0-or-later
"""What meshes of raw clouds are held to."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import Array
from helpers.reconstructions import area_vectors, volume

from hdpea import Reconstruction

BALL = 4 * np.pi / 3
"""Volume of the unit sphere."""


def assert_ball(made: Reconstruction, within: float = 0.03, full: float = BALL) -> None:
    """Assert one closed surface without handles that cuts itself nowhere, outside out, of that volume."""
    mesh = made.report.mesh
    assert (mesh.closed, mesh.components, mesh.genus, mesh.self_intersections) == (True, 1, 0, 0)
    assert volume(made) == pytest.approx(full, rel=within)


def middles(made: Reconstruction) -> Array:
    """Return the middles of the faces (f, 3)."""
    return np.asarray(made.vertices[made.faces].mean(axis=1))


def area(made: Reconstruction) -> float:
    return float(np.linalg.norm(area_vectors(made), axis=1).sum())


def share_of_area(made: Reconstruction, chosen: Array) -> float:
    """Return the share of the area in the chosen faces (f,)."""
    areas = np.linalg.norm(area_vectors(made), axis=1)
    return float(areas[chosen].sum() / areas.sum())


def share_against(made: Reconstruction, directions: Array) -> float:
    """Return the share of the area whose normal is against directions (f, 3) or (3,)."""
    return share_of_area(made, (area_vectors(made) * directions).sum(axis=1) < 0)


def says_it_is_a_guess(made: Reconstruction) -> bool:
    return any("guess" in note for note in made.report.notes)
