# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature from an embedding, by inverting its metric (HD-PEA paper, section 4.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.curvature.options import EMBEDDING_NEIGHBORS
from hdpea.curvature.tensors import Estimate
from hdpea.embedding.embedded import Embedded
from hdpea.options.choice import Choice
from hdpea.surface.surface import Surface

LEAST_RATIO = 1.1
"""Least ratio of the stretches with which the directions count as determined."""

LEAST_NEIGHBORS = 3
"""Of the same sheet; two do not determine a plane."""


def estimate_from_embedding(surface: Surface, embedded: Embedded, neighbors: int | None) -> Estimate:
    """Read the stretches and principal directions off an embedding.

    The tangent plane of the embedded surface is the graph of an affine fit of psi on the tangent plane in R^3. A
    unit step in it, projected to R^3, is 1 / s long: so the singular values of the first three rows of its
    orthonormal basis are 1 / s1 and 1 / s2, and the left singular vectors the principal directions.

    The HD-PEA paper fits a linear map R^3 -> R^8 instead, and takes its least singular vector for the normal. But psi
    is close to a multiple of the normal, so that the map stretches most along the normal and the order is lost.
    """
    count = neighbors or EMBEDDING_NEIGHBORS
    nearest = np.ascontiguousarray(surface.neighbors[:, :count])
    bases = _core.tangent_bases(embedded.coordinates, surface.normals, nearest)
    projected = bases.reshape(len(nearest), 2, -1)[:, :, :3]
    shrinking, vectors = np.linalg.eigh(np.einsum("nai,nbi->nab", projected, projected))
    stretches = 1 / np.sqrt(shrinking.clip(max=1))
    along1 = np.einsum("na,nai->ni", vectors[:, :, 0], projected)
    direction1 = along1 / np.linalg.norm(along1, axis=1, keepdims=True)
    known = (nearest >= 0).sum(axis=1) >= LEAST_NEIGHBORS
    stretches[~known] = np.nan
    metric = embedded.metric
    curvatures = np.full_like(stretches, np.nan) if metric is None else metric.curvatures(stretches)
    determined: NDArray[np.bool_] = known & (stretches[:, 0] >= LEAST_RATIO * stretches[:, 1])
    chosen = () if neighbors else (Choice("neighbors", count, "points", "steadier under noise than 6"),)
    return Estimate(surface.normals, direction1, stretches, curvatures, determined, (*embedded.choices, *chosen))
