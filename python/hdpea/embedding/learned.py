# SPDX-License-Identifier: GPL-3.0-or-later
"""The learned embedding: a network predicts psi."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hdpea import _core
from hdpea.embedding.embedded import Embedded
from hdpea.geometry.interpolation import Interpolation
from hdpea.geometry.thinning import thinned
from hdpea.options import EmbeddingOptions
from hdpea.options.choice import Choice
from hdpea.runtime.progress import PhaseCallback
from hdpea.runtime.pytorch import check_pytorch, torch_device
from hdpea.surface.surface import NEIGHBORS, Surface, area_shown

PER_VERTEX = (4.0, 12.0)
"""Least and most points per vertex that are embedded, 20,000 to 60,000 for 5,000 vertices: the included weights have
seen 2 to 12 in training, and are measured from 4 on."""


def embed_learned(surface: Surface, vertices: int, options: EmbeddingOptions, progress: PhaseCallback) -> Embedded:
    """Return the embedding [p, psi] of a surface by a network, at the scale of a mesh with that many `vertices`.

    A cloud of more points per vertex than there were in training is thinned before the network, and psi interpolated
    at all its points; one of fewer is embedded at the scale of the finest mesh that it could show. The metric is the
    one that the network was trained on.

    Raises
    ------
    UsageError
        If PyTorch is not installed, or has no such device.
    UnreadableInput
        If the weights cannot be read.
    Interrupted
        If `progress` cancels.
    """
    check_pytorch()
    # torch takes more than a second to load, and no other embedding needs it.
    from hdpea.network.inference import predict_psi
    from hdpea.network.weights import SHIPPED, read_weights

    points, normals, neighbors = surface.points_in_unit, surface.normals, surface.neighbors
    network = read_weights(SHIPPED if options.weights is None else Path(options.weights))
    network.to(torch_device(options.device))
    least, most = PER_VERTEX
    shown = min(vertices, len(points) / least)
    spacing = float(np.sqrt(area_shown(points, neighbors) / shown))
    kept = thinned(len(points), round(most * shown))
    if len(kept) < len(points):
        points, normals = points[kept], normals[kept]
        neighbors = _core.sheet_neighbors(points, normals, _core.nearest_neighbors(points, NEIGHBORS))
    psi = predict_psi(network, points, normals, neighbors, spacing, options.whole_points, progress)
    if len(kept) < len(surface.points_in_unit):
        psi = Interpolation.of(points, normals, surface.points_in_unit, surface.normals)(psi)
    in_world, of_weights = spacing * surface.frame.diagonal, "what the weights were trained for"
    limit = f", one for every {least:g} points: there is no finer one" if round(shown) < vertices else ""
    choices = (
        Choice("metric_spacing", in_world, "world units", f"that of {round(shown):,} vertices{limit}"),
        Choice("metric_scale", network.metric.scale * in_world, "world units", of_weights),
        Choice("max_stretch", network.metric.max_stretch, "", of_weights),
    )
    return Embedded(np.hstack([surface.points_in_unit, psi]), choices, network.metric.at(spacing))
