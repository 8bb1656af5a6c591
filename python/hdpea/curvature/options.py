# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of the estimation of curvature, as in ``hdpea.options``."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options import Checked, EmbeddingOptions, NormalOptions, option
from hdpea.options.meshing import POINTS_PER_VERTEX

EMBEDDING_NEIGHBORS = 40
"""Of the embedding's metric; the paper has 6. With noise more is better, without it makes no difference."""

NORMAL_NEIGHBORS_PER_NOISE, MOST_NORMAL_NEIGHBORS = 400, 200
"""Of the normals that the embedding bends by: for each spacing of noise, and the most.

A plane's slope is off by 2 sqrt(pi) noise / (spacing n) with n neighbours: so by half a degree."""

JET_NEIGHBORS = 24
"""Of a jet where the points are clean: fewer are no better."""

MOST_JET_NEIGHBORS = 216
"""Of a jet where they are noisy."""

MOST_POINTS = 100_000
"""Points that tensors are estimated at, unless more vertices are asked for; a larger cloud is thinned.

Eight for each of 12,500 vertices, which lie 0.7 % of the diagonal apart on a typical surface: about the smallest radius
of curvature that the metric can express, 1/128 of the diagonal."""


@dataclass(frozen=True)
class EstimationOptions(Checked):
    """How curvature is estimated (``hdpea.curvature``)."""

    method: str = option(
        "embedding",
        "embedding: from distances in R^8, gives |k|; jet: quadratic fit to the points, gives k with its sign",
        choices=("embedding", "jet"),
    )
    neighbors: int | None = option(
        None,
        f"nearest points of the same sheet that a tensor is fitted to; default: {EMBEDDING_NEIGHBORS}; for jet "
        f"{JET_NEIGHBORS}, up to {MOST_JET_NEIGHBORS} where the points are noisy",
        minimum=6,
    )
    vertices: int | None = option(
        None,
        f"the embedding shows as much detail as a mesh of so many vertices; default: one for every {POINTS_PER_VERTEX} "
        f"points, at most {MOST_POINTS // POINTS_PER_VERTEX:,}; a cloud of more than {MOST_POINTS:,} points and more "
        f"than {POINTS_PER_VERTEX} for each vertex is thinned to these, and tensors are carried over to all points",
        minimum=4,
    )


@dataclass(frozen=True)
class CurvatureOptions(Checked):
    """Everything ``hdpea.estimate_curvature`` can be told."""

    estimation: EstimationOptions = EstimationOptions()
    normals: NormalOptions = NormalOptions()
    embedding: EmbeddingOptions = EmbeddingOptions()
    threads: int = option(0, "threads to use; 0: all cores (the result is the same for any number)", minimum=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.embedding.metric_scale == 0:
            raise UsageError("A metric of scale 0 stretches nothing.", "Give a `metric_scale` above 0.")
