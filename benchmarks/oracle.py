# SPDX-License-Identifier: GPL-3.0-or-later
"""The oracle: the true embedding of a mesh in place of one estimated from the points, as an upper bound."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.ground_truth import embed_mesh
from hdpea.dataset.options import GroundTruthOptions
from hdpea.embedding import Embedder
from hdpea.embedding.embedded import Embedded
from hdpea.options import EmbeddingOptions
from hdpea.surface.surface import Surface

ORACLE = "oracle"


def oracle_embedder(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], options: GroundTruthOptions | None = None
) -> Embedder:
    """Return an embedder for samples of this mesh that looks up the truth."""
    truth = embed_mesh(vertices, faces, options)

    def embed(surface: Surface, _: int, __: EmbeddingOptions, ___: Callable[[float], bool]) -> Embedded:
        at_points = truth.at(truth.frame.to_unit(surface.frame.to_world(surface.points_in_unit)))
        # psi is a length: it scales with the frame, which for samples is a little smaller than for the mesh.
        psi = at_points.psi * (truth.frame.diagonal / surface.frame.diagonal)
        return Embedded(np.hstack([surface.points_in_unit, psi]))

    return embed
