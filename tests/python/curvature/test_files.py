# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds

from hdpea import CurvatureTensors, estimate_curvature
from hdpea.cli import run
from hdpea.curvature import writing
from hdpea.curvature.options import MOST_NORMAL_NEIGHBORS
from hdpea.curvature.writing import CURVATURE_FORMATS, arrays_of, columns_of, write_curvature
from hdpea.errors import UsageError
from hdpea.reading import read_points
from hdpea.runtime.marks import is_marked

Failed = Callable[..., str]


@pytest.fixture(scope="module")
def tensors() -> CurvatureTensors:
    return estimate_curvature(*clouds.ellipsoid(1_000))


@pytest.fixture
def scan(tmp_path: Path) -> Path:
    np.savetxt(tmp_path / "scan.xyz", np.hstack(clouds.torus(800)))
    return tmp_path / "scan.xyz"


@pytest.mark.parametrize("name", ["out.ply", "out.csv"])
def test_columns_read_back_exactly(tensors: CurvatureTensors, name: str, tmp_path: Path) -> None:
    write_curvature(tmp_path / name, tensors)
    cloud = read_points(tmp_path / name)
    np.testing.assert_array_equal(cloud.points, tensors.points)
    assert cloud.normals is not None
    np.testing.assert_allclose(cloud.normals, tensors.normals, atol=1e-15)
    assert set(cloud.attributes) == set(columns_of(tensors))
    np.testing.assert_array_equal(cloud.attributes["curvature2"], tensors.curvatures[:, 1])
    np.testing.assert_array_equal(cloud.attributes["direction1_z"], tensors.direction1[:, 2])
    np.testing.assert_array_equal(cloud.attributes["metric_xz"], tensors.metric[:, 0, 2])
    np.testing.assert_array_equal(cloud.attributes["determined"], tensors.determined)
    np.testing.assert_array_equal(cloud.attributes["point_index"], np.arange(1_000))
    assert is_marked(tmp_path / name, "curvature")


def test_arrays_read_back_exactly(tensors: CurvatureTensors, tmp_path: Path) -> None:
    write_curvature(tmp_path / "out.npz", tensors)
    with np.load(tmp_path / "out.npz") as file:
        np.testing.assert_array_equal(file["points"], tensors.points)
        assert set(file) == {"points", *arrays_of(tensors)}
        for name, array in arrays_of(tensors).items():
            np.testing.assert_array_equal(file[name], array)


def test_a_table_of_others_is_not_taken_for_its_own(tmp_path: Path) -> None:
    (tmp_path / "normals.csv").write_text("x,y,z,nx,ny,nz\n0,0,0,0,0,1\n")
    assert not is_marked(tmp_path / "normals.csv", "curvature")


@pytest.mark.slow
def test_vtp_holds_every_array(tensors: CurvatureTensors, tmp_path: Path) -> None:
    import pyvista

    write_curvature(tmp_path / "out.vtp", tensors)
    assert is_marked(tmp_path / "out.vtp", "curvature")
    cloud = pyvista.read(tmp_path / "out.vtp")
    np.testing.assert_array_equal(cloud.points, tensors.points)
    for name, array in arrays_of(tensors).items():
        np.testing.assert_array_equal(np.asarray(cloud.point_data[name]).reshape(array.shape), array)


def test_vtp_without_pyvista_says_what_to_install(
    tensors: CurvatureTensors, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(writing, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="pyvista") as caught:
        write_curvature(tmp_path / "out.vtp", tensors)
    assert "hdpea[picture]" in caught.value.hint


def test_the_command_tells_what_it_found(scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["curvature", str(scan), str(tmp_path / "out.ply")]) == 0
    told = capsys.readouterr()
    assert told.out == ""
    for part in ("neighbors: 40 points", "range: |k| from", "stretching ratio: median", "directions: determined at"):
        assert part in told.err
    assert len(read_points(tmp_path / "out.ply").points) == 800


def test_the_methods_differ_in_signs(scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for method in ("embedding", "jet"):
        written = str(tmp_path / f"{method}.npz")
        assert run(["curvature", str(scan), written, "--method", method, "--quiet", "--json"]) == 0
        told = json.loads(capsys.readouterr().out)
        assert told["signed"] == (told["curvature_range"] is None) == (method == "jet")
    with np.load(tmp_path / "embedding.npz") as embedding, np.load(tmp_path / "jet.npz") as jet:
        assert (embedding["curvatures"] > 0).all()
        assert (jet["curvatures"] < 0).any()


def test_quiet_is_silent(scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["curvature", str(scan), str(tmp_path / "out.csv"), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_what_cannot_be_written_is_refused_before_the_work(scan: Path, tmp_path: Path, failed: Failed) -> None:
    assert "extension" in failed(2, "curvature", scan, tmp_path / "out.obj")
    assert "extension" in failed(2, "curvature", scan, tmp_path / "out.ply", "--picture", tmp_path / "glyphs.jpg")
    assert "extension" in failed(2, "curvature", scan, tmp_path / "out.ply", "--page", tmp_path / "glyphs.txt")
    assert "no folder" in failed(2, "curvature", scan, tmp_path / "none" / "out.ply")
    source = scan.rename(scan.with_suffix(".csv"))
    assert "both input and output" in failed(2, "curvature", source, source)
    assert list(tmp_path.iterdir()) == [source]


def test_errors_have_their_codes(scan: Path, tmp_path: Path, failed: Failed) -> None:
    out = tmp_path / "out.ply"
    failed(3, "curvature", tmp_path / "none.ply", out)
    assert "neighbors is at least 6" in failed(2, "curvature", scan, out, "--neighbors", "3")
    (tmp_path / "line.xyz").write_text("".join(f"{i} 0 0\n" for i in range(50)))
    assert "on a line" in failed(4, "curvature", tmp_path / "line.xyz", out)
    assert not out.exists()


def test_the_help_tells_how_many_neighbours_a_normal_has_here(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["curvature", "--help"]) == 0
    assert f"at most {MOST_NORMAL_NEIGHBORS};" in " ".join(capsys.readouterr().out.split())


def test_every_format_is_in_the_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["curvature", "--help"]) == 0
    told = capsys.readouterr().out
    assert all(extension[1:].upper() in told for extension in CURVATURE_FORMATS)
