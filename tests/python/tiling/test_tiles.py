# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from distributed import LocalCluster
from helpers import clouds

from hdpea import _core
from hdpea.errors import UsageError
from hdpea.geometry.triangles import area_vectors_of
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import CleaningOptions, MeshingOptions, NormalOptions, Options
from hdpea.options.classes import Classes
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import PointStream, stream_of_cloud
from hdpea.result import Reconstruction
from hdpea.tiling import plan, tasks
from hdpea.tiling.cells import Cells
from hdpea.tiling.run import Tiling, reconstruct_in_tiles

POINTS, TILE_POINTS = 6_000, 4_000


@pytest.fixture(scope="module", autouse=True)
def _narrow_halos() -> Iterator[None]:
    """With halos as usual, tiles of so few points would be all halo."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plan, "HALO", 5.0)
        patch.setattr(plan, "HALO_OF_VERTICES", 4.0)
        yield


def torus_stream(normals: bool = True) -> PointStream:
    points, directions = clouds.torus(POINTS)
    return stream_of_cloud(PointCloud(points, directions if normals else None, {}), "torus")


def test_classes_are_taken_before_tiles_are_cut(tmp_path: Path) -> None:
    points = clouds.torus(POINTS)[0]
    classes = np.repeat([2, 5], [POINTS, 500])
    trees = 3 * np.random.default_rng(0).random((500, 3))
    cloud = PointCloud(np.vstack([points, trees]), None, {"classification": classes})
    options = Options(cleaning=CleaningOptions(classes=Classes.of([2])))
    alone = reconstruct_in_tiles(
        stream_of_cloud(PointCloud(points, None, {}), "torus"), Tiling(tmp_path / "a", 1e9, tile_points=TILE_POINTS)
    )
    taken = reconstruct_in_tiles(
        stream_of_cloud(cloud, "scene"), Tiling(tmp_path / "b", 1e9, tile_points=TILE_POINTS), options
    )
    np.testing.assert_array_equal(taken.vertices, alone.vertices)
    assert "Taken: the 6,000 of 6,500 points that are of the classes 2." in taken.report.notes
    none = Options(cleaning=CleaningOptions(classes=Classes.of([6])))
    with pytest.raises(UsageError, match="No point is of the"):
        reconstruct_in_tiles(stream_of_cloud(cloud, "scene"), Tiling(tmp_path / "c", 1e9), none)


def test_the_report_says_the_reference_system(tmp_path: Path) -> None:
    points, directions = clouds.torus(POINTS)
    stream = stream_of_cloud(PointCloud(points, directions, {}, crs="EPSG:25832"), "torus")
    made = reconstruct_in_tiles(stream, Tiling(tmp_path / "a", 1e9, tile_points=TILE_POINTS))
    assert made.crs == made.report.source["crs"] == "EPSG:25832"


def test_each_stray_is_told_once_though_tiles_overlap(tmp_path: Path) -> None:
    points = clouds.torus(POINTS)[0]
    strays = 0.3 * np.array([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1.0, 1)])
    stream = stream_of_cloud(PointCloud(np.vstack([points, strays]), None, {}), "torus")
    report = reconstruct_in_tiles(stream, Tiling(tmp_path / "a", 1e9, tile_points=TILE_POINTS)).report
    assert report.counts["tiles"] > 1
    assert (report.counts["dropped_strays"], report.counts["points"]) == (len(strays), POINTS)
    assert "Dropped points that lie on no surface: 18." in report.notes


def made(folder: Path, jobs: int = 1, normals: bool = True, scheduler: str | None = None) -> Reconstruction:
    tiling = Tiling(folder / "work", 1e9, jobs, scheduler, tile_points=TILE_POINTS)
    return reconstruct_in_tiles(torus_stream(normals), tiling)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Reconstruction:
    folder = tmp_path_factory.mktemp("tiles")
    result = made(folder)
    assert not (folder / "work").exists()
    return result


def test_a_torus_in_tiles_is_one_closed_surface_with_its_hole(whole: Reconstruction) -> None:
    assert whole.report.counts["tiles"] == 4
    mesh = whole.report.mesh
    assert (mesh.closed, mesh.genus, mesh.components, mesh.vertices) == (True, 1, 1, POINTS // 8)
    assert whole.report.distances.rms < 0.1 * whole.report.distances.spacing


def test_seams_do_not_show(whole: Reconstruction) -> None:
    points, _ = clouds.torus(POINTS)
    frame = UnitFrame.around(points)
    in_unit = frame.to_unit(points)
    tiles = plan.plan_tiles(Cells.of([in_unit]), frame, Options(), TILE_POINTS)
    distances = _core.closest_surface_points(whole.vertices, whole.faces, points).distance
    corners = whole.vertices[whole.faces]
    spacing = np.sqrt(np.linalg.norm(area_vectors_of(corners), axis=1).sum() / len(whole.vertices)) / frame.diagonal
    at_seam = sum(tiles.inside(tile, in_unit, 2 * spacing).astype(int) for tile in range(tiles.tiles)) > 1
    assert 0.1 < at_seam.mean() < 0.6
    assert np.square(distances[at_seam]).mean() < 1.1**2 * np.square(distances[~at_seam]).mean()


def test_processes_that_go_on_with_a_killed_run_give_the_same_bytes(
    whole: Reconstruction, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def killed(*_: object) -> None:
        raise KeyboardInterrupt

    finishing = tasks.STAGES["finishing"]
    monkeypatch.setitem(tasks.STAGES, "finishing", (finishing[0], killed))
    with pytest.raises(KeyboardInterrupt):
        made(tmp_path)
    monkeypatch.setitem(tasks.STAGES, "finishing", finishing)
    kept = tmp_path / "work" / "particles.0.npz"
    kept.unlink()  # so that two processes begin in the middle
    again = made(tmp_path, jobs=2)
    np.testing.assert_array_equal(again.vertices, whole.vertices)
    np.testing.assert_array_equal(again.faces, whole.faces)


def test_a_cluster_of_which_a_worker_is_killed_gives_the_same_bytes(whole: Reconstruction, tmp_path: Path) -> None:
    def killed(cluster: LocalCluster) -> None:
        while not any((tmp_path / "work").glob("particles.*")):
            time.sleep(0.02)
        os.kill(cluster.workers[0].process.pid, signal.SIGKILL)

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        killer = threading.Thread(target=killed, args=(cluster,), daemon=True)
        killer.start()
        again = made(tmp_path, scheduler=cluster.scheduler_address)
        assert not killer.is_alive()
    np.testing.assert_array_equal(again.vertices, whole.vertices)
    np.testing.assert_array_equal(again.faces, whole.faces)


def test_a_cluster_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="There is no Dask scheduler at nowhere://"):
        made(tmp_path, scheduler="nowhere://")


def test_tiles_without_normals_agree_on_the_outside(tmp_path: Path) -> None:
    mesh = made(tmp_path, normals=False)
    corners = mesh.vertices[mesh.faces]
    assert mesh.report.mesh.closed
    assert np.einsum("fc,fc->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) > 0


def test_a_part_that_is_missing_is_told(tmp_path: Path) -> None:
    crumb = 0.01 * clouds.sphere(60)[0] + [0, 0, 1.0]
    stream = stream_of_cloud(PointCloud(np.vstack([clouds.torus(POINTS)[0], crumb]), None, {}), "torus")
    report = reconstruct_in_tiles(stream, Tiling(tmp_path / "a", 1e9, tile_points=TILE_POINTS)).report
    assert report.mesh.components == 1
    assert any("A part may be missing" in note for note in report.notes)


@pytest.mark.parametrize("orient", ["auto", "viewpoint"])
def test_tiles_know_their_sensors(tmp_path: Path, orient: Literal["auto", "viewpoint"]) -> None:
    points, outward = clouds.torus(POINTS)
    within = points - 0.2 * outward
    stream = stream_of_cloud(PointCloud(points, None, {"sensor": within}), "tunnel")
    options = Options(normals=NormalOptions(orient=orient))
    mesh = reconstruct_in_tiles(stream, Tiling(tmp_path / "a", 1e9, tile_points=TILE_POINTS), options)
    corners = mesh.vertices[mesh.faces]
    assert mesh.report.counts["tiles"] > 1
    assert np.einsum("fc,fc->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) < 0


def test_neither_processes_nor_memory_change_the_tiles_if_there_is_enough() -> None:
    alone, four, little = Tiling(Path(), 8e9), Tiling(Path(), 64e9, 4), Tiling(Path(), 1e9, 4)
    sizes = [each.sizes(Options(), 10**8)[0] for each in (alone, four, little)]
    assert sizes[0] == sizes[1] == plan.TILE_POINTS > sizes[2]
    assert [each.workers(size, 8.0) for each, size in zip((alone, four, little), sizes, strict=True)] == [1, 4, 1]
    with pytest.raises(UsageError, match="memory"):
        Tiling(Path(), 1e6).sizes(Options(), 10**8)


def test_tiles_that_would_be_all_halo_are_made_twice_as_large() -> None:
    points = np.random.default_rng(0).random((5_000, 3)) * [1, 1, 0]
    frame = UnitFrame.around(points)
    cells, few = Cells.of([frame.to_unit(points)]), Options(meshing=MeshingOptions(vertices=100))
    with pytest.raises(UsageError, match="halo"):
        plan.plan_tiles(cells, frame, few, 2_000)
    some, more = (plan.plan_tiles(cells, frame, few, 2_000, most).tile_points for most in (10**4, 10**6))
    assert some == more > 2_000


def test_a_wider_collar_makes_neighbours_of_tiles_farther_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """What two tiles edit that are no neighbours stays apart, whatever the collar is."""
    points = np.random.default_rng(0).random((20_000, 3)) * [1, 0.02, 0]
    frame = UnitFrame.around(points)
    cells = Cells.of([frame.to_unit(points)])
    for collar in (plan.COLLAR, 1.5):
        monkeypatch.setattr(plan, "COLLAR", collar)
        tiles = plan.plan_tiles(cells, frame, Options(), 1_300)
        one, other = np.nonzero(~tiles.neighbors & ~np.eye(tiles.tiles, dtype=bool))
        apart = np.maximum(tiles.low[one, 0] - tiles.high[other, 0], tiles.low[other, 0] - tiles.high[one, 0])
        assert len(one) > 0
        assert (apart - 2 * tiles.collar >= 0.999 * plan.APART * tiles.halo).all()


def test_points_far_away_are_told() -> None:
    points = np.vstack([np.random.default_rng(0).random((5_000, 3)), [[1e6, 0, 0]]])
    frame = UnitFrame.around(points)
    with pytest.raises(UsageError, match="one place"):
        plan.plan_tiles(Cells.of([frame.to_unit(points)]), frame, Options(), 1_000)


@pytest.mark.parametrize("jobs", [1, 2])
def test_errors_of_tasks_keep_their_kind(tmp_path: Path, jobs: int) -> None:
    options = Options(normals=NormalOptions(orient="viewpoint"))
    with pytest.raises(UsageError, match="viewpoint"):
        reconstruct_in_tiles(torus_stream(), Tiling(tmp_path / "work", 1e9, jobs, tile_points=TILE_POINTS), options)


def test_a_file_is_no_folder_to_work_in_and_stays(tmp_path: Path) -> None:
    file = tmp_path / "notes.txt"
    file.write_text("mine")
    with pytest.raises(UsageError, match=r"notes\.txt is a file, no folder to work in\."):
        reconstruct_in_tiles(torus_stream(), Tiling(file, 1e9, tile_points=TILE_POINTS))
    assert file.read_text() == "mine"


def test_what_tiles_do_not_have_is_refused(tmp_path: Path) -> None:
    options = Options(meshing=MeshingOptions(watertight=True))
    with pytest.raises(UsageError, match="watertight"):
        reconstruct_in_tiles(torus_stream(), Tiling(tmp_path / "work", 1e9), options)
