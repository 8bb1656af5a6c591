# SPDX-License-Identifier: GPL-3.0-or-later
"""The same cloud out of every format."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from helpers.files import NORMALS, POINTS, WITH_NORMALS, WITHOUT_NORMALS, lines, ply
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy
from numpy.typing import NDArray

from hdpea.reading import read_points


@pytest.mark.parametrize("name", WITH_NORMALS)
def test_points_and_normals_come_back(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(WITH_NORMALS[name])
    cloud = read_points(tmp_path / name)
    np.testing.assert_array_equal(cloud.points, POINTS)
    assert cloud.normals is not None
    np.testing.assert_allclose(cloud.normals, NORMALS, atol=1e-15)


@pytest.mark.parametrize("name", WITHOUT_NORMALS)
def test_points_come_back_where_there_are_no_normals(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(WITHOUT_NORMALS[name])
    cloud = read_points(tmp_path / name)
    np.testing.assert_array_equal(cloud.points, POINTS)
    assert cloud.normals is None


@pytest.mark.parametrize("name", ["mesh.ply", "points.obj"])
def test_a_mesh_given_as_input_is_said_to_be_one(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(WITH_NORMALS[name])
    assert "mesh" in " ".join(read_points(tmp_path / name).notes)


def test_other_properties_are_kept_by_name(tmp_path: Path) -> None:
    (tmp_path / "extra.ply").write_bytes(ply(extra=True))
    attributes = read_points(tmp_path / "extra.ply").attributes
    assert list(attributes) == ["label"]
    assert attributes["label"].dtype == np.int32


def test_ply_whose_vertices_hold_lists_is_read(tmp_path: Path) -> None:
    text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
    (tmp_path / "lists.ply").write_text(text + "property list uchar int seen\nend_header\n0 0 1 2 5 6\n1 0 0 0\n")
    assert read_points(tmp_path / "lists.ply").points.tolist() == [[0, 0, 1], [1, 0, 0]]


@pytest.mark.parametrize("name", ["binary.ply", "plain.xyz", "normals.off", "points.obj", "wide.npy", "named.npz"])
def test_standard_input_is_told_by_its_content(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(WITH_NORMALS[name])))
    np.testing.assert_array_equal(read_points("-").points, POINTS)


@given(st_numpy.arrays(np.float64, (3, 3), elements=st.floats(-1e300, 1e300), unique=True))
def test_text_keeps_every_digit(points: NDArray[np.float64]) -> None:
    from hdpea.reading.text import parse_text

    np.testing.assert_array_equal(parse_text(lines(points).encode()).points, points)
