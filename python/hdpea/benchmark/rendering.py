# SPDX-License-Identifier: GPL-3.0-or-later
"""Similarity of renderings of two surfaces under one light: PSNR and SSIM (as in the HD-PEA paper, appendix G)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.triangles import TriangleMesh
from hdpea.pictures.picture import Camera, draw_mesh

SIZE = (512, 512)
"""Pixels of a picture."""

GREY = (200, 200, 200)
BEHIND = np.diag([-1.0, 1.0, -1.0])
"""Half a turn about the vertical axis of the view: each surface is rendered from two opposite sides."""

WINDOW, SIGMA = 11, 1.5
STABILIZERS = (0.01**2, 0.03**2)
"""Constants of SSIM, as in Wang, Bovik, Sheikh and Simoncelli (2004), for pictures from 0 to 1."""

LEAST_ERROR = 1e-10
"""Smallest mean squared error, so that equal pictures have 100 dB instead of infinity."""

Picture = NDArray[np.float64]


def compare_renderings(truth: TriangleMesh, mesh: TriangleMesh) -> dict[str, float]:
    """Return PSNR (dB) and SSIM (at most 1) of a mesh's flatly shaded pictures, against those of the truth.

    Both are means over the pixels covered by either surface, from two sides; call ``check_drawing`` first.
    """
    front = Camera.before(*truth)
    back = replace(front, view_from_world=BEHIND @ front.view_from_world, centre_in_view=BEHIND @ front.centre_in_view)
    errors, similarities = [], []
    for camera in (front, back):
        expected, seen = render(truth, camera), render(mesh, camera)
        covered = np.minimum(expected, seen) < 1
        errors.append(((expected - seen) ** 2)[covered])
        edge = WINDOW // 2
        similarities.append(structural_similarity(expected, seen)[covered[edge:-edge, edge:-edge]])
    error = float(np.concatenate(errors).mean())
    return {"psnr": -10 * float(np.log10(max(error, LEAST_ERROR))), "ssim": float(np.concatenate(similarities).mean())}


def render(mesh: TriangleMesh, camera: Camera) -> Picture:
    """Return a picture (h, w) from 0 to 1 of a mesh without its edges, on white."""
    from PIL import Image

    colors = np.tile(np.array(GREY, np.uint8), (len(mesh[0]), 1))
    with TemporaryDirectory() as folder:
        path = Path(folder) / "drawn.png"
        draw_mesh(path, *mesh, size=SIZE, camera=camera, colors=colors)
        with Image.open(path) as image:
            return np.asarray(image.convert("L"), np.float64) / 255


def structural_similarity(one: Picture, other: Picture) -> Picture:
    """Return the SSIM of two pictures (h, w) at each pixel whose window lies within them: (h - 10, w - 10)."""
    mean1, mean2 = _blurred(one), _blurred(other)
    variance1, variance2 = _blurred(one**2) - mean1**2, _blurred(other**2) - mean2**2
    covariance = _blurred(one * other) - mean1 * mean2
    c1, c2 = STABILIZERS
    alike = (2 * mean1 * mean2 + c1) * (2 * covariance + c2)
    return alike / ((mean1**2 + mean2**2 + c1) * (variance1 + variance2 + c2))


def _blurred(picture: Picture) -> Picture:
    offsets = np.arange(WINDOW) - WINDOW // 2
    weights = np.exp(-(offsets**2) / (2 * SIGMA**2))
    weights /= weights.sum()
    for axis in (0, 1):
        picture = np.lib.stride_tricks.sliding_window_view(picture, WINDOW, axis) @ weights
    return picture
