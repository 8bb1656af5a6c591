# SPDX-License-Identifier: GPL-3.0-or-later
"""How patches that close holes lie between the faces around them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.directions import directions_of
from hdpea.mesh.extraction import Mesh


@dataclass(frozen=True)
class Rims:
    """Patches, each at its label, and the faces around them; the means are weighted by the edges between the two.

    Attributes
    ----------
    towards
        (k, 3) unit: where the patch faces as a whole. Where the rim zigzags, some of its faces go on along the surface.
    areas
        (k,) float64: twice its area.
    flat
        (k,) float64: the share of this that is left seen from ahead.
    continued
        (k,) float64: mean cosine of the angle between the patch and the faces around it.
    behind
        (k,) float64: mean sine by which these lead away behind it.
    """

    towards: NDArray[np.float64]
    areas: NDArray[np.float64]
    flat: NDArray[np.float64]
    continued: NDArray[np.float64]
    behind: NDArray[np.float64]


def rims_of(mesh: Mesh, vectors: NDArray[np.float64], opposite: NDArray[np.int64], labels: NDArray[np.int64]) -> Rims:
    """Return how the last faces of a mesh lie, patches with `labels` (k,).

    Of all faces the area `vectors` (f, 3) are known, and which lie `opposite` (f, 3) across the edges.
    """
    count = len(labels)
    first = len(mesh.faces) - count
    areas = np.bincount(labels, np.linalg.norm(vectors[first:], axis=1), count).astype(np.float64)
    faced = np.zeros((count, 3))
    np.add.at(faced, labels, vectors[first:])
    towards = directions_of(faced)
    face, side = np.nonzero((opposite[first:] >= 0) & (opposite[first:] < first))
    ends = mesh.vertices_in_unit[np.stack([mesh.faces[first + face, side], mesh.faces[first + face, (side + 1) % 3]])]
    edges = ends[1] - ends[0]
    beyond = directions_of(vectors[opposite[first + face, side]])
    # Into the face beyond, which goes along the edge the other way.
    away = directions_of(np.cross(beyond, edges))
    at, lengths = labels[face], np.linalg.norm(edges, axis=1)
    around = _positive(np.bincount(at, lengths, count).astype(np.float64))
    continued, behind = (
        np.bincount(at, lengths * np.einsum("nc,nc->n", towards[at], each), count) / around for each in (beyond, away)
    )
    return Rims(towards, areas, np.linalg.norm(faced, axis=1) / _positive(areas), continued, behind)


def _positive(numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.maximum(numbers, np.finfo(np.float64).tiny)
