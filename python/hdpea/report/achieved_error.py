# SPDX-License-Identifier: GPL-3.0-or-later
"""Which error a mesh keeps from its points, beside the one that was asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.mesh.error_bound import ROUNDING, ErrorBound
from hdpea.mesh.extraction import Mesh
from hdpea.options.lengths import Length
from hdpea.surface.surface import Surface


@dataclass(frozen=True)
class AchievedError:
    """The largest distances between a mesh and its points, in world units.

    Attributes
    ----------
    asked
        None if no error was asked for.
    points_to_mesh
        Of a point, after any denoising, from the mesh.
    mesh_to_points
        Of a place of the mesh from its nearest points' planes; patches of holes do not count.
    moved_by_denoising
        How far denoising has moved a point at most: so much farther than `points_to_mesh` it may have been as given.
    """

    asked: float | None
    points_to_mesh: float
    mesh_to_points: float
    moved_by_denoising: float

    @property
    def larger(self) -> float:
        """The larger of the distances of the two sides."""
        return max(self.points_to_mesh, self.mesh_to_points)

    def missed(self) -> Iterator[str]:
        """Yield a sentence if the error that was asked for is not kept."""
        if self.asked is None or self.larger <= self.asked * ROUNDING:
            return
        if self.points_to_mesh >= self.mesh_to_points:
            yield f"A point is {self.points_to_mesh:.4g} from the mesh, farther than the error of {self.asked:.4g}."
        else:
            yield (
                f"A place of the mesh is {self.mesh_to_points:.4g} from what the points near it show, farther than the "
                f"error of {self.asked:.4g}."
            )


def achieved_error(
    mesh: Mesh, surface: Surface, given: Surface, asked: Length | None, distances: NDArray[np.float64]
) -> AchievedError:
    """Measure a mesh against the points that it was made from: of `surface`, and before denoising of `given`.

    `distances` (n,) are those of the points of `surface` from the mesh, in the unit frame.
    """
    diagonal = surface.frame.diagonal
    reached = ErrorBound(surface, 0.0).reached(mesh, distances=distances).in_world(diagonal)
    moved = np.linalg.norm(surface.points_in_unit - given.points_in_unit, axis=1).max() * diagonal
    error = None if asked is None else asked.resolve(diagonal)
    return AchievedError(error, reached.points_to_mesh, reached.mesh_to_points, float(moved))
