# SPDX-License-Identifier: GPL-3.0-or-later
"""No scan is ever destroyed, whatever is typed; many clouds; standard output."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds
from helpers.files import ply
from helpers.meshes import TETRAHEDRON_FACES, tetrahedron

from hdpea.cli import run
from hdpea.cli.batch import BY_GRAVITY, worst_of
from hdpea.cli.ended import Ended
from hdpea.errors import CannotReconstruct, HdpeaError, QualityMissed, UnreadableInput, UsageError
from hdpea.reading import read_points
from hdpea.runtime.marks import is_marked
from hdpea.writing.meshes import MESH_FORMATS, write_mesh
from hdpea.writing.points import point_ply, write_dropped

Capture = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def scans(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Three scans of 300 points in a folder of their own, which are the same afterwards."""
    monkeypatch.chdir(tmp_path)
    for seed, name in enumerate(("a.ply", "b.ply", "c.ply")):
        points, normals = clouds.sphere(300, seed)
        Path(name).write_bytes(point_ply(points, normals, {}))
    before = {name: Path(name).read_bytes() for name in ("a.ply", "b.ply", "c.ply")}
    yield
    assert {name: Path(name).read_bytes() for name in before} == before


@pytest.mark.parametrize("force", [[], ["--force"]])
@pytest.mark.parametrize(
    "arguments",
    [
        ["a.ply", "b.ply"],
        ["a.ply", "b.ply", "c.ply"],
        ["a.ply", "b.ply", "c.ply", "--merge"],
        ["a.ply", "a.ply"],
        ["a.ply", "m.ply", "--dropped", "a.ply"],
        ["a.ply", "b.ply", "m.obj", "--merge", "--dropped", "b.ply"],
        ["a.ply", "b.ply", "--out-dir", "m", "--merge"],
        ["a.ply", "b.ply", "--out-dir", "m", "--report", "r.json"],
        ["a.ply", "b.ply", "--out-dir", "m", "--work-dir", "w"],
        ["a.ply", "b.ply", "--out-dir", "m", "--verbose"],
        ["a.ply", "b.ply", "./a.ply", "--out-dir", "m"],
        ["a.ply", "m.obj", "--format", "stl"],
        ["a.ply", "-"],
        ["-"],
        ["a.ply", "-", "--format", "ply", "--json"],
    ],
)
def test_what_could_destroy_a_scan_or_is_unclear_is_refused(
    arguments: list[str], force: list[str], failed: Callable[..., str]
) -> None:
    failed(2, "reconstruct", *arguments, *force)
    assert {each.name for each in Path().iterdir() if each.is_file()} == {"a.ply", "b.ply", "c.ply"}


def test_a_scan_that_hdpea_wrote_is_one_too(failed: Callable[..., str]) -> None:
    assert is_marked(Path("b.ply"), "scan")
    assert "taken for a scan" in failed(2, "reconstruct", "a.ply", "b.ply", "--force")


def test_files_of_others_are_replaced_only_by_force(failed: Callable[..., str]) -> None:
    Path("other.ply").write_bytes(ply(faces=True))
    Path("other.json").write_text("{}")
    assert "no mesh that hdpea made" in failed(2, "reconstruct", "a.ply", "other.ply")
    assert "no report" in failed(2, "reconstruct", "a.ply", "m.ply", "--report", "other.json")
    assert Path("other.json").read_text() == "{}"
    assert run(["reconstruct", "a.ply", "other.ply", "--report", "other.json", "--quiet", "--force"]) == 0
    assert run(["reconstruct", "a.ply", "other.ply", "--report", "other.json", "--quiet"]) == 0
    assert is_marked(Path("other.ply"), "mesh")


@pytest.mark.parametrize("extension", MESH_FORMATS)
@pytest.mark.parametrize("center", [0.0, 1e7])
def test_every_format_is_marked(extension: str, center: float) -> None:
    path = Path(f"mesh{extension}")
    write_mesh(path, tetrahedron(center, 0.1), TETRAHEDRON_FACES)
    assert is_marked(path, "mesh")
    assert not is_marked(path, "scan")


@pytest.mark.parametrize("name", ["dropped.ply", "dropped.npz"])
def test_points_left_out_are_marked(name: str) -> None:
    write_dropped(Path(name), np.ones((2, 3)), np.ones(2, np.uint8))
    assert is_marked(Path(name), "set of dropped points")
    assert len(read_points(name).points) == 1


@pytest.mark.parametrize("command", ["embed", "curvature"])
def test_other_commands_ask_before_they_replace(command: str, failed: Callable[..., str]) -> None:
    assert "taken for a scan" in failed(2, command, "a.ply", "b.ply", "--force")
    Path("notes.npz").write_text("of something else")
    assert "no " in failed(2, command, "a.ply", "notes.npz")
    assert run([command, "a.ply", "notes.npz", "--quiet", "--force"]) == 0
    assert run([command, "a.ply", "out.ply", "--quiet"]) == 0
    assert run([command, "a.ply", "out.ply", "--quiet"]) == 0


def test_a_mesh_without_a_name_lies_beside_its_cloud() -> None:
    assert run(["reconstruct", "a.ply", "--quiet", "--format", "obj"]) == 0
    assert read_points("a.mesh.obj").points.shape == (37, 3)


def test_standard_output_holds_the_mesh_alone(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert run(["reconstruct", "a.ply", "m.ply", "--quiet"]) == 0
    capfdbinary.readouterr()
    assert run(["reconstruct", "a.ply", "-", "--format", "ply", "--quiet"]) == 0
    assert capfdbinary.readouterr().out == Path("m.ply").read_bytes()


def test_scans_of_one_thing_become_one_mesh() -> None:
    assert run(["reconstruct", "a.ply", "b.ply", "m.obj", "--merge", "--report", "r.json", "--quiet"]) == 0
    assert json.loads(Path("r.json").read_text())["counts"]["points"] == 600


@pytest.mark.slow
def test_each_cloud_has_a_mesh_and_a_line(capsys: Capture) -> None:
    Path("bad.xyz").write_text("nothing\n")
    assert run(["reconstruct", "a.ply", "bad.xyz", "b.ply", "--out-dir", "new/meshes", "--json", "--jobs", "2"]) == 3
    out, told = capsys.readouterr()
    lines = {line["inputs"][0]: line for line in map(json.loads, out.splitlines())}
    assert {name: line["exit_code"] for name, line in lines.items()} == {"a.ply": 0, "b.ply": 0, "bad.xyz": 3}
    assert "bad.xyz" in lines["bad.xyz"]["error"]
    assert {each.name for each in Path("new/meshes").iterdir()} == {"a.mesh.ply", "b.mesh.ply"}
    assert "1 of 3 went wrong: bad.xyz" in told
    # The same as alone.
    assert run(["reconstruct", "a.ply", "--quiet", "--report", "a.json"]) == 0
    assert json.loads(Path("a.json").read_text())["options"] == lines["a.ply"]["report"]["options"]
    assert Path("a.mesh.ply").read_bytes() == Path("new/meshes/a.mesh.ply").read_bytes()


def test_meshes_of_an_earlier_run_are_no_clouds(failed: Callable[..., str]) -> None:
    write_mesh("a.mesh.ply", tetrahedron(), TETRAHEDRON_FACES)
    assert "meshes that hdpea made" in failed(2, "reconstruct", "a.mesh.ply", "--out-dir", ".")
    assert "no file none.ply" in failed(3, "reconstruct", "none.ply", "a.mesh.ply", "--out-dir", ".")


def ended(kind: type[HdpeaError] | None) -> Ended:
    return Ended(("scan.ply",), "mesh.ply", kind=kind)


def test_the_gravest_error_is_that_of_the_batch() -> None:
    assert worst_of([ended(None)]) is None
    worst = worst_of([ended(None), ended(UnreadableInput), ended(QualityMissed), ended(CannotReconstruct)])
    assert isinstance(worst, CannotReconstruct)
    assert set(BY_GRAVITY) == {QualityMissed, UsageError, UnreadableInput, CannotReconstruct, HdpeaError}
