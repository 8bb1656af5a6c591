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
from hdpea.outputs import check_output, replacing
from hdpea.picture import MARGIN, PICTURE_FORMATS, check_drawing, load_pyvista
from hdpea.viewpoint import choose_view_of_points

Colors = NDArray[np.uint8]

STROKES = 600
"""Strokes along the direction of the smaller curvature."""

STROKE_LENGTH = 0.02
"""Of a stroke where the stretches are equal, which draws a dot, to this where they differ most; of the diagonal."""

MOST_ANISOTROPIC = 4.0
"""Ratio of the stretches from which the colour is red."""

PANEL = (800, 800)
"""Width and height of a panel in pixels."""


def draw_sample(path: Path, sample: Sample, options: GroundTruthOptions | None = None) -> None:
    """Draw the points of a sample coloured by normal, by psi, and by how anisotropic the metric of `options` is.

    Parameters
    ----------
    path
        A PNG file, replaced only once the new one is complete.

    Raises
    ------
    UsageError
        If nothing can be drawn on this machine, or the file cannot be written.
    """
    check_output(path, PICTURE_FORMATS)
    check_drawing()
    pyvista = load_pyvista()
    view_from_unit = choose_view_of_points(sample.points.astype(np.float64), sample.normals.astype(np.float64))
    points = sample.points @ view_from_unit.T
    facing = (sample.normals @ view_from_unit.T)[:, 2] > 0
    options = options or GroundTruthOptions()
    stretch = stretches(sample.curvatures, options, spacing_of(sample, options))
    ratio = stretch[:, 0] / stretch[:, 1]
    panels = [normal_colors(sample.normals), psi_colors(sample.psi), ratio_colors(ratio)]

    plotter = pyvista.Plotter(
        off_screen=True, shape=(1, len(panels)), window_size=[PANEL[0] * len(panels), PANEL[1]], border=False
    )
    plotter.background_color = pyvista.Color("white")
    size = _point_size(int(facing.sum()))
    for column, colors in enumerate(panels):
        plotter.subplot(0, column)
        # Points hide nothing behind them: those of the far side are left out.
        plotter.add_points(
            points[facing],
            scalars=colors[facing],
            rgb=True,
            point_size=size,
            render_points_as_spheres=True,
            lighting=False,
        )
        _look_at(plotter, points)
    direction2 = np.cross(sample.normals, sample.direction1) @ view_from_unit.T
    _add_strokes(plotter, pyvista, points, direction2, ratio, np.flatnonzero(facing))
    with replacing(path) as partial:
        plotter.screenshot(partial)
    plotter.close()


def normal_colors(normals: NDArray[np.float32]) -> Colors:
    """Return x, y and z of unit normals (n, 3) as red, green and blue (n, 3)."""
    return _bytes((normals + 1) / 2)


def psi_colors(psi: NDArray[np.float32]) -> Colors:
    """Return the first three principal components of psi (n, 5) as red, green and blue (n, 3), 1st to 99th percentile.

    The same psi gives the same colours, whatever signs the decomposition chose.
    """
    centred = psi.astype(np.float64) - psi.mean(axis=0, dtype=np.float64)
    _, _, axes = np.linalg.svd(centred.T @ centred)
    axes *= np.sign(axes[np.arange(len(axes)), abs(axes).argmax(axis=1)])[:, None]
    components = centred @ axes[:3].T
    low, high = np.percentile(components, [1, 99], axis=0)
    return _bytes((components - low) / np.maximum(high - low, 1e-12))


def ratio_colors(ratio: NDArray[np.float64]) -> Colors:
    """Return ratios of stretches (n,) as colours (n, 3): blue where 1, over grey to red where ``MOST_ANISOTROPIC``."""
    share = (np.log(ratio) / np.log(MOST_ANISOTROPIC)).clip(0, 1)
    anchors = np.array([[0.23, 0.30, 0.75], [0.87, 0.87, 0.87], [0.71, 0.02, 0.15]])
    return _bytes(np.column_stack([np.interp(share, [0, 0.5, 1], anchors[:, channel]) for channel in range(3)]))


def _bytes(shares: NDArray[Any]) -> Colors:
    colors: Colors = np.rint(255 * shares.clip(0, 1)).astype(np.uint8)
    return colors


def _point_size(points: int) -> float:
    """Return the width in pixels at which so many random points leave few gaps in a third of their panel."""
    return float(np.clip(2.5 * (PANEL[0] * PANEL[1] / 3 / max(points, 1)) ** 0.5, 2, 40))


def _look_at(plotter: Any, points: NDArray[np.float64]) -> None:
    low, high = points.min(axis=0), points.max(axis=0)
    (x, y, z), (width, height, _) = (low + high) / 2, high - low
    plotter.camera_position = [(x, y, z + 2), (x, y, z), (0, 1, 0)]
    plotter.camera.parallel_projection = True
    plotter.camera.parallel_scale = MARGIN * max(height, width * PANEL[1] / PANEL[0]) / 2


def _add_strokes(
    plotter: Any,
    pyvista: Any,
    points: NDArray[np.float64],
    direction2: NDArray[np.float64],
    ratio: NDArray[np.float64],
    facing: NDArray[np.int64],
) -> None:
    """Draw strokes at evenly spread points, the longer the more anisotropic, just in front of the points."""
    from hdpea import _core

    facing_points = np.ascontiguousarray(points[facing], np.float64)
    chosen = facing[_core.farthest_point_sampling(facing_points, min(STROKES, len(facing)))]
    half = STROKE_LENGTH * (np.log(ratio[chosen]) / np.log(MOST_ANISOTROPIC)).clip(0, 1)[:, None] * direction2[chosen]
    middles = points[chosen] + [0, 0, 0.02]
    ends = np.stack([middles - half, middles + half], axis=1).reshape(-1, 3)
    plotter.add_mesh(pyvista.line_segments_from_points(ends), color="black", line_width=2)
