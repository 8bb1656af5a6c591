# SPDX-License-Identifier: GPL-3.0-or-later
"""Embeddings to compare with those of hdpea."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from oracle import ORACLE, oracle_embedder

from hdpea.embedding import Embedder
from hdpea.embedding.embedded import Embedded
from hdpea.options import EmbeddingOptions
from hdpea.surface.surface import Surface

NORMAL_FACTOR = 0.05
"""Factor on the normals, in diagonals, of the 6-D embedding [p, s n] that remeshers use (Levy and Bonneel 2013)."""


def embed_isotropically(surface: Surface, _: int, __: EmbeddingOptions, ___: Callable[[float], bool]) -> Embedded:
    """Embed without psi: the metric is Euclidean."""
    return Embedded(np.pad(surface.points_in_unit, ((0, 0), (0, 5))))


def embed_by_normals(surface: Surface, _: int, __: EmbeddingOptions, ___: Callable[[float], bool]) -> Embedded:
    """Embed in R^6 by the normals alone."""
    psi = np.pad(NORMAL_FACTOR * surface.normals, ((0, 0), (0, 2)))
    return Embedded(np.hstack([surface.points_in_unit, psi]))


REFERENCES: dict[str, Callable[[NDArray[np.float64], NDArray[np.int64]], Embedder]] = {
    ORACLE: oracle_embedder,
    "isotropic": lambda *_: embed_isotropically,
    "normals": lambda *_: embed_by_normals,
}
"""By name, a function from the true mesh to the embedder of its samples."""
