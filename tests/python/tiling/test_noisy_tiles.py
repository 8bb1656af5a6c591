# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise counts in tiles as it does in one piece."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers import clouds

from hdpea import reconstruct
from hdpea.options import MeshingOptions, Options
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import stream_of_cloud
from hdpea.report.report import Report
from hdpea.tiling import plan
from hdpea.tiling.run import Tiling, reconstruct_in_tiles

POINTS, TILE_POINTS = 10_000, 8_000

NOISE = 0.5
"""Standard deviation, in spacings (a spacing is the square root of the area per point)."""


@pytest.fixture(autouse=True)
def _narrow_halos(monkeypatch: pytest.MonkeyPatch) -> None:
    """With halos as usual, tiles of so few points would be all halo."""
    monkeypatch.setattr(plan, "HALO", 5.0)
    monkeypatch.setattr(plan, "HALO_OF_VERTICES", 4.0)


def noisy_sphere() -> tuple[clouds.Array, clouds.Array]:
    """Return points and the normals of the sphere."""
    noise = np.random.default_rng(0).normal(scale=NOISE * np.sqrt(4 * np.pi / POINTS), size=(POINTS, 1))
    points, normals = clouds.sphere(POINTS)
    return (1 + noise) * points, normals


def in_tiles(folder: Path, options: Options, normals: bool = False) -> Report:
    points, directions = noisy_sphere()
    stream = stream_of_cloud(PointCloud(points, directions if normals else None, {}), "sphere")
    return reconstruct_in_tiles(stream, Tiling(folder / "work", 1e9, tile_points=TILE_POINTS), options).report


def test_noisy_tiles_have_the_vertices_asked_for(tmp_path: Path) -> None:
    report = in_tiles(tmp_path, Options(meshing=MeshingOptions(vertices=POINTS // 8)))
    assert report.counts["tiles"] > 1
    assert not report.missed
    assert report.mesh.closed
    # As many particles for each as where points are denoised in one piece.
    assert {each.name: each.value for each in report.choices}["particles"] == POINTS // 4


def test_noise_allows_tiles_as_few_vertices_as_one_piece(tmp_path: Path) -> None:
    report, whole = in_tiles(tmp_path, Options(), normals=True), reconstruct(*noisy_sphere()).report
    assert report.counts["tiles"] > 1
    assert not report.missed
    assert report.mesh.vertices == whole.mesh.vertices < POINTS // 8
    assert report.distances.spacing == pytest.approx(whole.distances.spacing, rel=0.02)
    assert report.distances.rms < 1.05 * whole.distances.rms
    # Of the points after denoising, as is documented: as they were given they lie twice as far off and more.
    assert report.error.points_to_mesh < 0.5 * report.distances.max
