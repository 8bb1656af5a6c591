# SPDX-License-Identifier: GPL-3.0-or-later
"""Psi of a whole cloud by a trained network."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray

from hdpea import _core
from hdpea.network.clouds import Clouds, centred_points
from hdpea.network.transformer import PointTransformer

SAMPLING = (0.0025, 0.010)
"""Distances to the 6th neighbour, unit frame, that training has seen: of 60,000 points of a small area to 20,000 of a
large one."""

SIXTH = 6


def sampling_scale(points: NDArray[np.floating]) -> float:
    """Return the factor that brings points (n, 3) to a sampling that training has seen; 1 for most models.

    The network's metric is one of curvature in the unit frame, so a cloud is scaled no more than it must be.
    """
    neighbors = _core.nearest_neighbors(np.ascontiguousarray(points, np.float64), SIXTH)
    sixth = float(np.median(np.linalg.norm(points[neighbors[:, -1]] - points, axis=1)))
    return float(np.clip(sixth, *SAMPLING)) / sixth


def predict_psi(
    network: PointTransformer, points: NDArray[np.floating], normals: NDArray[np.floating], scale: float | None = None
) -> NDArray[np.float64]:
    """Return the extra coordinates psi (n, 5) of points, in their own units.

    Points are put in an order of their own first, so that theirs does not matter to the last bit.

    Parameters
    ----------
    points
        (n, 3), distinct; a bounding-box diagonal of 1 is what the network knows.
    normals
        (n, 3), unit, consistently oriented.
    scale
        Factor on the points before the network, taken from psi again: the metric becomes that of the scaled cloud.
        Default: ``sampling_scale``.
    """
    centred = centred_points(points)
    order = np.lexsort(centred.T)
    scale = sampling_scale(centred[order]) if scale is None else scale
    clouds = Clouds.of(scale * centred[order], normals[order], network.options.stem_neighbors)
    was_training = network.training
    network.eval()
    with torch.no_grad():
        predicted = network(clouds.to(next(network.parameters()).device)).cpu().numpy()
    network.train(was_training)
    psi = np.empty(predicted.shape)
    psi[order] = predicted / scale
    return psi
