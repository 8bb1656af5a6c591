# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a sample: its normals, its embedding and its curvature, side by side."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import GroundTruthOptions
from hdpea.dataset.quality import spacing_of, stretches
from hdpea.dataset.sample import Sample
from hdpea.pictures.camera import choose_view_of_points, mean_sight
from hdpea.pictures.colors import MOST_ANISOTROPIC, Colors, as_bytes, ratio_colors
from hdpea.pictures.picture import drawn_to, look_at, point_size

STROKES = 600
"""Number of strokes drawn along the direction of the smaller curvature."""

STROKE_LENGTH = 0.02
"""Longest stroke, in diagonals, where the stretches differ most; where they are equal it is a dot."""

PANEL = (800, 800)
"""Width and height of a panel in pixels."""


def draw_sample(path: Path, sample: Sample) -> None:
    """Draw the points of a sample coloured by normal, by psi, and by how anisotropic the default metric is.

    Parameters
    ----------
    path
        A PNG file, replaced only once the new one is complete.

    Raises
    ------
    UsageError
        If nothing can be drawn on this machine, or the file cannot be written.
    """
    sight = mean_sight(sample.points, sample.sensors)
    view_from_unit = choose_view_of_points(sample.points.astype(np.float64), sample.normals.astype(np.float64), sight)
    points = sample.points @ view_from_unit.T
    facing = (sample.normals @ view_from_unit.T)[:, 2] > 0
    options = GroundTruthOptions()
    stretch = stretches(sample.curvatures, options, spacing_of(sample, options))
    ratio = stretch[:, 0] / stretch[:, 1]
    panels = [normal_colors(sample.normals), psi_colors(sample.psi), ratio_colors(ratio)]

    size = point_size(int(facing.sum()), PANEL)
    direction2 = np.cross(sample.normals, sample.direction1) @ view_from_unit.T
    window = [PANEL[0] * len(panels), PANEL[1]]
    with drawn_to(path, shape=(1, len(panels)), window_size=window, border=False) as (pyvista, plotter):
        for column, colors in enumerate(panels):
            plotter.subplot(0, column)
            # Points do not hide what is behind them, so those facing away are left out.
            plotter.add_points(
                points[facing],
                scalars=colors[facing],
                rgb=True,
                point_size=size,
                render_points_as_spheres=True,
                lighting=False,
            )
            look_at(plotter, points, PANEL)
        _add_strokes(plotter, pyvista, points, direction2, ratio, np.flatnonzero(facing))


def normal_colors(normals: NDArray[np.float32]) -> Colors:
    """Return x, y and z of unit normals (n, 3) as red, green and blue (n, 3)."""
    return as_bytes((normals + 1) / 2)


def psi_colors(psi: NDArray[np.float32]) -> Colors:
    """Return the first three principal components of psi (n, 5) as red, green and blue (n, 3), 1st to 99th percentile.

    The same psi gives the same colours, whatever signs the decomposition chooses.
    """
    centred = psi.astype(np.float64) - psi.mean(axis=0, dtype=np.float64)
    _, _, axes = np.linalg.svd(centred.T @ centred)
    axes *= np.sign(axes[np.arange(len(axes)), abs(axes).argmax(axis=1)])[:, None]
    components = centred @ axes[:3].T
    low, high = np.percentile(components, [1, 99], axis=0)
    return as_bytes((components - low) / np.maximum(high - low, 1e-12))


def _add_strokes(
    plotter: Any,
    pyvista: Any,
    points: NDArray[np.float64],
    direction2: NDArray[np.float64],
    ratio: NDArray[np.float64],
    facing: NDArray[np.int64],
) -> None:
    """Draw strokes at evenly spaced points, longer where the metric is more anisotropic, in front of the points."""
    from hdpea import _core

    facing_points = np.ascontiguousarray(points[facing], np.float64)
    chosen = facing[_core.farthest_point_sampling(facing_points, min(STROKES, len(facing)))]
    half = STROKE_LENGTH * (np.log(ratio[chosen]) / np.log(MOST_ANISOTROPIC)).clip(0, 1)[:, None] * direction2[chosen]
    middles = points[chosen] + [0, 0, 0.02]
    ends = np.stack([middles - half, middles + half], axis=1).reshape(-1, 3)
    plotter.add_mesh(pyvista.line_segments_from_points(ends), color="black", line_width=2)
