# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds

from hdpea.errors import UsageError
from hdpea.options import MeshingOptions, Options
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import PointStream, stream_of_cloud
from hdpea.result import Reconstruction
from hdpea.tiling import plan, tasks
from hdpea.tiling.run import Tiling, reconstruct_in_tiles

POINTS = 6_000


@pytest.fixture(autouse=True)
def _narrow_halos(monkeypatch: pytest.MonkeyPatch) -> None:
    """With halos as usual, tiles of so few points would be all halo."""
    monkeypatch.setattr(plan, "HALO", 5.0)
    monkeypatch.setattr(plan, "HALO_OF_VERTICES", 4.0)


def torus_stream(normals: bool = True) -> PointStream:
    points, directions = clouds.torus(POINTS)
    return stream_of_cloud(PointCloud(points, directions if normals else None, {}), "torus")


def made(folder: Path, jobs: int = 1, normals: bool = True) -> Reconstruction:
    tiling = Tiling(folder / "work", 1e9, jobs, tile_points=3_000)
    return reconstruct_in_tiles(torus_stream(normals), tiling, Options())


def test_a_torus_in_tiles_is_one_closed_surface_with_its_hole(tmp_path: Path) -> None:
    result = made(tmp_path)
    assert result.report.counts["tiles"] >= 4
    mesh = result.report.mesh
    assert (mesh.closed, mesh.genus, mesh.components, mesh.vertices) == (True, 1, 1, POINTS // 8)
    assert result.report.distances.rms < 0.1 * result.report.distances.spacing
    assert not (tmp_path / "work").exists()


def test_processes_and_a_run_that_was_killed_give_the_same_bytes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = made(tmp_path / "whole")
    finish = tasks.STAGES["finishing"]

    def killed(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setitem(tasks.STAGES, "finishing", (finish[0], killed))
    with pytest.raises(KeyboardInterrupt):
        made(tmp_path / "killed")
    kept = (tmp_path / "killed" / "work" / "particles.0.npz").stat().st_mtime_ns
    monkeypatch.setitem(tasks.STAGES, "finishing", finish)
    begun = list[int]()
    spread = tasks.STAGES["particles"]
    monkeypatch.setitem(tasks.STAGES, "particles", (spread[0], lambda _, tile: begun.append(tile)))
    again = made(tmp_path / "killed", jobs=2)
    assert kept
    assert not begun
    np.testing.assert_array_equal(again.vertices, whole.vertices)
    np.testing.assert_array_equal(again.faces, whole.faces)


def test_tiles_without_normals_agree_on_the_outside(tmp_path: Path) -> None:
    mesh = made(tmp_path, normals=False)
    corners = mesh.vertices[mesh.faces]
    assert mesh.report.mesh.closed
    assert np.einsum("fc,fc->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) > 0


def test_what_tiles_do_not_have_is_refused(tmp_path: Path) -> None:
    options = Options(meshing=MeshingOptions(watertight=True))
    with pytest.raises(UsageError, match="watertight"):
        reconstruct_in_tiles(torus_stream(), Tiling(tmp_path / "work", 1e9), options)
