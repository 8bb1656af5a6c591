# SPDX-License-Identifier: GPL-3.0-or-later
"""Psi of a whole cloud by a trained network."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray

from hdpea.network.clouds import Clouds, centred_points
from hdpea.network.transformer import PointTransformer
from hdpea.surface import Surface, area_shown

AREA_NEIGHBORS = 12
"""Nearest points of the same sheet that the area is taken from, as the ground truth does."""


def surface_psi(network: PointTransformer, surface: Surface, vertices: int) -> NDArray[np.float64]:
    """Return psi (n, 5) of a surface in its unit frame, at the scale that a mesh of so many `vertices` can show."""
    points = surface.points_in_unit
    spacing = np.sqrt(area_shown(points, surface.neighbors[:, :AREA_NEIGHBORS]) / vertices)
    return predict_psi(network, points, surface.normals, surface.neighbors, float(spacing))


def predict_psi(
    network: PointTransformer,
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    neighbors: NDArray[np.int64],
    spacing: float,
) -> NDArray[np.float64]:
    """Return the extra coordinates psi (n, 5) of points, in their own units.

    Points are put in an order of their own first, so that theirs does not matter to the last bit.

    Parameters
    ----------
    points
        (n, 3), distinct.
    normals
        (n, 3), unit, consistently oriented.
    neighbors
        (n, k): nearest points of the same sheet, nearest first, -1 pads.
    spacing
        sqrt(area / vertices) of the mesh to come, in the points' units: the scale of the metric.
    """
    centred = centred_points(points) / spacing
    order = np.lexsort(centred.T)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    sorted_neighbors = np.where(neighbors < 0, neighbors, place[neighbors])[order]
    clouds = Clouds.of(centred[order], normals[order], np.ascontiguousarray(sorted_neighbors))
    was_training = network.training
    network.eval()
    with torch.no_grad():
        predicted = network(clouds.to(next(network.parameters()).device)).cpu().numpy()
    network.train(was_training)
    psi = np.empty(predicted.shape)
    psi[order] = predicted * spacing
    return psi
