# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of the estimation of curvature, as in ``hdpea.options``."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options import Checked, CleaningOptions, EmbeddingOptions, NormalOptions, option
from hdpea.options.meshing import POINTS_PER_VERTEX

EMBEDDING_NEIGHBORS = 40
"""That the metric of an embedding is fitted to. The HD-PEA paper (section 4.2) takes 6; with noise, more are better."""

NORMAL_NEIGHBORS_PER_NOISE, MOST_NORMAL_NEIGHBORS = 400, 200
"""Neighbours that normals are fitted to for an embedding: per spacing of noise, and at most.

The slope of a plane has the standard error 2 sqrt(pi) noise / (spacing n) with n neighbours: here half a degree."""

NORMAL_NEIGHBORS_HELP = (
    f"nearest points whose plane gives an estimated normal; default: {NORMAL_NEIGHBORS_PER_NOISE} for each spacing of "
    f"noise, at most {MOST_NORMAL_NEIGHBORS}; for jet, and where the points are clean, as `hdpea reconstruct` takes"
)
"""Of `normal_neighbors`, of which other stages take fewer."""

JET_NEIGHBORS = 24
"""Of a jet where the points are clean: fewer are no better."""

MOST_JET_NEIGHBORS = 216
"""Of a jet where they are noisy."""

MOST_POINTS = 100_000
"""Most points at which tensors are estimated, unless more vertices are asked for; a larger cloud is thinned.

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
        f"than {POINTS_PER_VERTEX} for each vertex is thinned to these, and tensors are interpolated at all points",
        minimum=4,
    )


@dataclass(frozen=True)
class CurvatureOptions(Checked):
    """All options of ``hdpea.estimate_curvature``."""

    estimation: EstimationOptions = EstimationOptions()
    normals: NormalOptions = NormalOptions()
    embedding: EmbeddingOptions = EmbeddingOptions()
    cleaning: CleaningOptions = CleaningOptions()
    threads: int = option(0, "threads to use; 0: all cores (the result is the same for any number)", minimum=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.embedding.metric_scale == 0:
            raise UsageError("A metric of scale 0 stretches nothing.", "Give a `metric_scale` above 0.")
