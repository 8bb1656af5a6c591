# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import dataset_standins
from helpers.dataset_standins import open_mesh, write_meshes

from hdpea.dataset.build import build_dataset, seed_of
from hdpea.dataset.loading import Dataset
from hdpea.dataset.manifest import Manifest, MeshEntry, read_manifest
from hdpea.dataset.options import DatasetOptions
from hdpea.errors import QualityMissed, UnreadableInput, UsageError
from hdpea.options.settings import filled


@pytest.fixture(autouse=True)
def _stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.dataset.build.make_samples", dataset_standins.make_samples)


def options(points: int = 100, seed: int = 0, jobs: int = 1, time_limit: float = 60) -> DatasetOptions:
    return filled(DatasetOptions, {"points": points, "seed": seed, "jobs": jobs, "time_limit": time_limit})


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()
    }


def entries(manifest: Manifest) -> dict[str, MeshEntry]:
    return {each.name: each for each in manifest.meshes}


def test_every_mesh_gets_a_sample(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "b", "c")
    build_dataset(str(meshes), tmp_path / "out", options())
    dataset = Dataset(tmp_path / "out")
    assert dataset.names == ["a", "b", "c"]
    assert [len(sample.points) for sample in dataset] == [100, 100, 100]
    assert set(contents(tmp_path / "out")) == {
        "manifest.json",
        "DATASET_CARD.md",
        *(f"samples/{name}.npz" for name in "abc"),
    }


def test_the_bytes_depend_neither_on_jobs_nor_on_where_the_meshes_lie(tmp_path: Path) -> None:
    for folder, jobs in (("one", 1), ("other", 2)):
        meshes = write_meshes(tmp_path / folder, "a", "b", "bug", "c", "d")
        open_mesh(meshes / "open.ply")
        build_dataset(str(meshes), tmp_path / folder / "out", options(jobs=jobs))
    assert contents(tmp_path / "one" / "out") == contents(tmp_path / "other" / "out")


def test_seeds_go_by_name_and_seed() -> None:
    assert seed_of("a", 0) == seed_of("a", 0)
    assert len({seed_of(name, seed) for name in ("a", "b") for seed in (0, 1)}) == 4


def test_whatever_goes_wrong_with_a_mesh_it_alone_is_skipped(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "bug", "crash", "hang", "z")
    open_mesh(meshes / "open.ply")
    (meshes / "text.ply").write_text("no mesh")
    (meshes / "empty.ply").write_text("")
    told: list[str] = []
    built = build_dataset(str(meshes), tmp_path / "out", options(time_limit=4), told.append)
    reasons = {each.name: each.skipped for each in built.manifest.meshes}
    assert [name for name, reason in reasons.items() if reason is None] == ["a", "z"]
    assert reasons["bug"] == "ZeroDivisionError: a bug"
    assert reasons["crash"] == "Its process ended with signal SIGSEGV."
    assert reasons["hang"] == "It took longer than 4 s."
    assert reasons["open"] == "open.ply is not a closed, manifold surface: 3 edges at holes."
    assert str(reasons["text"]).startswith("Cannot read text.ply: it is no mesh, or damaged")
    assert str(reasons["empty"]).startswith("Cannot read empty.ply")
    assert sum("skipped" in line for line in told) == 6
    card = (tmp_path / "out" / "DATASET_CARD.md").read_text()
    assert "- bug: ZeroDivisionError: a bug" in card


def test_licences_are_taken_from_a_manifest_above_the_meshes(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "b", "c")
    (meshes / "of").mkdir()
    (meshes / "a.ply").rename(meshes / "of" / "a.ply")
    manifest = (meshes / "MANIFEST.json").read_text().replace('"a.ply"', '"of/a.ply"')
    (meshes / "MANIFEST.json").write_text(manifest)
    made = entries(build_dataset(str(meshes / "of"), tmp_path / "of", options()).manifest)
    assert (made["a"].licence, made["a"].origin) == ("licence 0", "a site: at/a")
    made = entries(build_dataset(str(meshes), tmp_path / "all", options()).manifest)
    assert {name: each.licence for name, each in made.items()} == {
        "b": "licence 1",
        "c": "unstated",
        "of/a": "licence 0",
    }
    card = (tmp_path / "all" / "DATASET_CARD.md").read_text()
    for licence in ("licence 0", "licence 1", "unstated"):
        assert f"| {licence} | 1 | 1 |" in card


def test_meshes_of_one_name_are_told_apart(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a")
    import trimesh

    trimesh.creation.box().export(meshes / "a.stl")
    build_dataset(str(meshes), tmp_path / "out", options())
    assert Dataset(tmp_path / "out").names == ["a.ply", "a.stl"]


def test_a_finished_dataset_is_kept_and_a_damaged_or_changed_part_made_anew(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "b", "c")
    build_dataset(str(meshes), tmp_path / "out", options())
    whole = contents(tmp_path / "out")
    (tmp_path / "out" / "samples" / "b.npz").write_bytes(b"damaged")
    for half_written in ("samples/.c.123.npz", ".manifest.123.json"):
        (tmp_path / "out" / half_written).write_bytes(b"by a killed run")
    assert build_dataset(str(meshes), tmp_path / "out", options()).kept == 2
    assert contents(tmp_path / "out") == whole
    write_meshes(tmp_path / "meshes", "0", "b")  # b is of another size now
    assert build_dataset(str(meshes), tmp_path / "out", options()).kept == 1
    assert Dataset(tmp_path / "out").names == ["0", "a", "b", "c"]


def stand_in(*arguments: str | Path) -> list[str]:
    return [
        sys.executable,
        "-m",
        "helpers.dataset_standins",
        "dataset",
        "build",
        *map(str, arguments),
        "--points",
        "100",
    ]


def read_until(process: subprocess.Popen[bytes], words: bytes) -> None:
    assert process.stderr is not None
    told = b""
    while words not in told:
        byte = process.stderr.read(1)
        assert byte, told.decode()
        told += byte


@pytest.mark.slow
def test_a_killed_run_is_continued(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", *(f"slow_{number}" for number in range(6)))
    script = stand_in(meshes, tmp_path / "out", "--jobs", "2")
    process = subprocess.Popen(script, stderr=subprocess.PIPE)
    read_until(process, b"(2 of 6)")
    process.kill()
    process.communicate(timeout=10)
    earlier = read_manifest(tmp_path / "out")
    assert 2 <= len(earlier.samples) < 6
    ran = subprocess.run(script, capture_output=True, text=True, check=True)
    assert f"{len(earlier.samples)} there already, 0 skipped" in ran.stderr
    build_dataset(str(meshes), tmp_path / "at once", options())
    assert contents(tmp_path / "out") == contents(tmp_path / "at once")


@pytest.mark.slow
def test_ctrl_c_ends_at_once_and_keeps_what_is_finished(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "hang")
    process = subprocess.Popen(
        stand_in(meshes, tmp_path / "out", "--jobs", "1"), stderr=subprocess.PIPE, start_new_session=True
    )
    read_until(process, b"(1 of 2)")
    os.killpg(process.pid, signal.SIGINT)
    told = process.communicate(timeout=10)[1].decode()
    assert process.returncode == 130
    assert "Error: Interrupted" in told
    assert "Traceback" not in told
    assert set(contents(tmp_path / "out")) == {"manifest.json", "samples/a.npz"}
    assert Dataset(tmp_path / "out").names == ["a"]


@pytest.mark.parametrize(
    ("changed", "told"),
    [(options(points=99), "points = 100, not 99"), (options(seed=1), "seed = 0, not 1")],
)
def test_other_options_need_another_folder(changed: DatasetOptions, told: str, tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a")
    build_dataset(str(meshes), tmp_path / "out", options())
    with pytest.raises(UsageError, match=told):
        build_dataset(str(meshes), tmp_path / "out", changed)


def test_other_meshes_versions_and_folders_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a")
    build_dataset(str(meshes), tmp_path / "out", options())
    with pytest.raises(UsageError, match="samples of other meshes: a"):
        build_dataset(str(write_meshes(tmp_path / "others", "b")), tmp_path / "out", options())
    with pytest.raises(UsageError, match="not empty, and not a dataset"):
        build_dataset(str(meshes), meshes, options())
    with pytest.raises(UsageError, match="Cannot write to"):
        build_dataset(str(meshes), meshes / "a.ply", options())
    monkeypatch.setattr("hdpea.dataset.build.version", lambda: "9")
    with pytest.raises(UsageError, match="this is 9"):
        build_dataset(str(meshes), tmp_path / "out", options())


def test_without_a_single_mesh_there_is_no_dataset(tmp_path: Path) -> None:
    with pytest.raises(UnreadableInput, match="no file or folder"):
        build_dataset(str(tmp_path / "meshes"), tmp_path / "out", options())
    (tmp_path / "empty").mkdir()
    with pytest.raises(UnreadableInput, match="no meshes"):
        build_dataset(str(tmp_path / "empty"), tmp_path / "out", options())
    with pytest.raises(QualityMissed, match="None of the 1 meshes"):
        build_dataset(str(write_meshes(tmp_path / "meshes", "bug")), tmp_path / "out", options())


def test_a_damaged_list_of_licences_is_told(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a")
    (meshes / "MANIFEST.json").write_text('{"files": 5}')
    with pytest.raises(UnreadableInput, match=r"Cannot read the licences in .*MANIFEST\.json"):
        build_dataset(str(meshes), tmp_path / "out", options())
