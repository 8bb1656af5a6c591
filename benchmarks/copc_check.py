# SPDX-License-Identifier: GPL-3.0-or-later
"""A COPC file of another program, read: docs/formats.md.

    pip install copclib && apt-get install libcgal-demo
    python benchmarks/copc_check.py

copc-lib (RockRobotic) writes a cloud of libcgal-demo in world coordinates, with intensities and classes, into an octree
of three levels. Every point that is read must be one that was written, with what it had.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import click
import copclib
import numpy as np
from demo_data import CLOUDS, demo_files
from numpy.typing import NDArray

from hdpea import read_points

ORIGIN, SCALE = (500_000.0, 4_000_000.0, 100.0), 1e-4
"""Of the file's integers: metres of a projected CRS."""

LEVELS = 3


def write_copc(path: Path, steps: NDArray[np.int64], intensity: NDArray[np.int64], classes: NDArray[np.int64]) -> None:
    """Write points (n, 3), in steps of the scale from the origin, into cells of levels in turn."""
    scale, origin = copclib.Vector3(SCALE, SCALE, SCALE), copclib.Vector3(*ORIGIN)
    config = copclib.CopcConfigWriter(7, scale, origin, "")
    low, size = steps.min(axis=0), int(np.ptp(steps, axis=0).max()) + 1
    corners = ORIGIN + SCALE * low, ORIGIN + SCALE * (low + size)
    header = config.las_header
    header.min, header.max = (copclib.Vector3(*each) for each in corners)
    config.copc_info.center_x, config.copc_info.center_y, config.copc_info.center_z = np.mean(corners, axis=0)
    config.copc_info.halfsize = SCALE * size / 2
    config.copc_info.spacing = SCALE * size / 32
    writer = copclib.FileWriter(str(path), config)
    for level in range(LEVELS):
        rows = np.arange(level, len(steps), LEVELS)
        cells = (steps[rows] - low) * 2**level // size
        for cell in np.unique(cells, axis=0):
            points = copclib.Points(header)
            for row in rows[(cells == cell).all(axis=1)]:
                point = points.CreatePoint()
                point.x, point.y, point.z = ORIGIN + SCALE * steps[row]
                point.intensity, point.classification = int(intensity[row]), int(classes[row])
                points.AddPoint(point)
            writer.AddNode(copclib.VoxelKey(level, *map(int, cell)), points)
    writer.Close()


@click.command()
def main() -> None:
    """Write a file, read it, compare."""
    with TemporaryDirectory() as name:
        cloud, *_ = demo_files(Path(name), CLOUDS, ["kitten.xyz"])
        steps = np.rint(read_points(cloud).points * 100 / SCALE).astype(np.int64)
        steps = np.unique(steps, axis=0)
        intensity, classes = 1 + np.arange(len(steps)), np.arange(len(steps)) % 7
        path = Path(name) / "kitten.copc.laz"
        write_copc(path, steps, intensity, classes)
        read = read_points(path)
    found = np.rint((read.points - ORIGIN) / SCALE).astype(np.int64)
    order = np.lexsort(found.T[::-1])
    np.testing.assert_array_equal(found[order], steps)
    np.testing.assert_allclose(read.points[order], ORIGIN + SCALE * steps, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(read.attributes["intensity"][order], intensity)
    np.testing.assert_array_equal(read.attributes["classification"][order], classes)
    click.echo(f"{len(steps):,} points in {LEVELS} levels: read as they were written.")


if __name__ == "__main__":
    main()
