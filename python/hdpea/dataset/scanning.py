# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans of a mesh by a simulated range sensor, similar to BlenSor (Gschwandtner et al., 2011)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.outliers import draw_outliers
from hdpea.dataset.scan import Scan
from hdpea.dataset.scan_faults import quantised
from hdpea.dataset.scanner import Scanner
from hdpea.errors import CannotReconstruct

FIRST_RESOLUTION = 64
"""Pixels across of the first pass, from which the resolution that is needed is estimated."""

SURPLUS = 1.3
"""Points seen for every point wanted, so that a random choice among them breaks up the grid of the pixels."""

LARGEST_RESOLUTION = 2048
"""Highest resolution: a model that yields too few points even then is all but invisible."""


def scan_surface(vertices: NDArray[np.float64], faces: NDArray[np.int64], options: ScanOptions | None = None) -> Scan:
    """Scan a mesh (v, 3), (f, 3) in its unit frame, whose faces are oriented outward; the same for the same seed.

    Whatever no ray reaches is missing: cavities, deep pockets, the underside on a turntable. A face hit from behind
    returns nothing, since the sensor is outside. The resolution is chosen so that somewhat more points than wanted
    are seen; those that are kept are chosen at random.

    Raises
    ------
    UsageError
        If embreex is not installed.
    CannotReconstruct
        If the sensor sees nothing, or too little of the mesh.
    """
    options = options or ScanOptions()
    rng = np.random.default_rng(options.seed)
    strays, *of_scanner = rng.spawn(3)  # faults draw from streams of their own: without them all else is the same
    scanner = Scanner(vertices, faces, options, rng, *of_scanner)
    resolution = FIRST_RESOLUTION
    scan = scanner.look(resolution)
    while len(scan.points) < options.points:
        finer = (SURPLUS * options.points / max(len(scan.points), 1)) ** 0.5
        resolution = max(int(resolution * finer), resolution + 1)
        if not len(scan.points) or resolution > LARGEST_RESOLUTION:
            raise CannotReconstruct(
                "The sensor sees too little of the mesh.", "Do its faces look outward? If so, ask for fewer points."
            )
        scan = scanner.look(resolution)
    scan = scan.at(np.sort(rng.choice(len(scan.points), options.points, replace=False)))
    if options.outliers:
        scan = _with_outliers(scan, options.outliers, strays)
    return replace(scan, points=quantised(scan.points, options.step)) if options.step else scan


def _with_outliers(scan: Scan, share: float, rng: np.random.Generator) -> Scan:
    outliers = draw_outliers(scan.points, scan.surface_points, share, rng)
    truth = np.arange(len(scan.points))
    truth[outliers.rows] = outliers.nearest
    points = scan.points.copy()
    points[outliers.rows] = outliers.places
    return replace(scan.at(truth), points=points, sensors=scan.sensors)
