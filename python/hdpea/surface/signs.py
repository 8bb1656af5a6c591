# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known of the signs of normals, and what is made of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.roughness import Roughness
from hdpea.surface.given_signs import GivenSigns
from hdpea.surface.single_view import View

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class SignEvidence:
    """What is known of the signs of normals (n, 3) besides their directions.

    Attributes
    ----------
    given
        (n, 3) float64: normals whose signs may be used, of length 1, or 0 where there is none.
    estimated
        (n,) bool: which directions are estimates, not given.
    neighbors
        (n, k) int64: nearest other points, -1 pads.
    roughness
        Of the points.
    origin
        (3,) float64: that of the file, where a camera may have been.
    sensors
        (n, 3) float64, what saw each point; None if the file does not say.
    signs
        What is thought of the signs of the given normals; None without any.
    """

    given: Vectors
    estimated: NDArray[np.bool_]
    neighbors: NDArray[np.int64]
    roughness: Roughness
    origin: Vectors
    sensors: Vectors | None = None
    signs: GivenSigns | None = None

    def of_rows(self, rows: NDArray[np.int64], points: Vectors) -> SignEvidence:
        """Return what is known of the rows (m,) alone, whose points are (m, 3)."""
        return replace(
            self,
            given=self.given[rows],
            estimated=self.estimated[rows],
            neighbors=_core.nearest_neighbors(points, self.neighbors.shape[1]),
            sensors=None if self.sensors is None else self.sensors[rows],
        )


@dataclass(frozen=True)
class Orientation:
    """Oriented unit normals (n, 3), and how they became so.

    Attributes
    ----------
    normals
        (n, 3) float64.
    method
        One of ``NormalOptions.orient``.
    why
        Why this method was chosen.
    view
        From where the points were seen, where that decided the signs.
    sensors_refused
        Whether sensors were known, and cannot have seen the points.
    seams
        Whether strips that overlap and do not meet had opposite sides, and were turned.
    """

    normals: Vectors
    method: str
    why: str = ""
    view: View | None = None
    sensors_refused: bool = False
    seams: bool = False


def turned(directions: Vectors, towards: Vectors) -> Vectors:
    """Return the directions (n, 3), those flipped that point away from the vectors `towards` (n, 3)."""
    return np.where(cosines(directions, towards) < 0, -1, 1)[:, None] * directions


def cosines(a: Vectors, b: Vectors) -> Vectors:
    """Return the scalar products of the rows of two arrays (n, 3)."""
    return np.asarray(np.einsum("nc,nc->n", a, b))
