# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds of other libraries are taken as they are, and meshes given back as theirs."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import torch
import trimesh
from helpers.clouds import sphere_points

from hdpea import Reconstruction, reconstruct
from hdpea.errors import UsageError
from hdpea.reading.attributes import split_colors
from hdpea.reading.cleaning import cleaned_cloud

POINTS = sphere_points(600)
COLORS = np.rint(255 * abs(POINTS)).astype(np.uint8)


def pdal_table() -> np.ndarray[Any, Any]:
    """Return what a pipeline of PDAL has in its ``arrays``."""
    names = ["X", "Y", "Z", "NormalX", "NormalY", "NormalZ", "Red", "Green", "Blue", "ReturnNumber", "GpsTime"]
    columns = [*POINTS.T, *POINTS.T, *(257 * COLORS.astype(np.uint16)).T, np.ones(600, np.uint8), 1e9 + POINTS[:, 0]]
    return np.rec.fromarrays(columns, names=names).view(np.ndarray)


def pyvista_cloud() -> Any:
    pyvista = pytest.importorskip("pyvista")
    cloud = pyvista.PolyData(POINTS)
    cloud.point_data["Normals"], cloud.point_data["RGB"] = POINTS, COLORS
    return cloud


def open3d_cloud() -> Any:
    """Return the cloud of Open3D, or, where it is not installed, what has the same arrays."""
    try:
        import open3d
    except ImportError:
        return SimpleNamespace(points=POINTS, normals=POINTS, colors=COLORS / 255)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(POINTS))
    cloud.normals, cloud.colors = (open3d.utility.Vector3dVector(each) for each in (POINTS, COLORS / 255))
    return cloud


CLOUDS: dict[str, Callable[[], Any]] = {
    "PDAL": pdal_table,
    "PyVista": pyvista_cloud,
    "Open3D": open3d_cloud,
    "Open3D, tensors": lambda: SimpleNamespace(
        point={
            name: torch.tensor(each)
            for name, each in {"positions": POINTS, "normals": POINTS, "colors": COLORS}.items()
        }
    ),
    "pandas": lambda: SimpleNamespace(to_records=lambda index: pdal_table()),  # noqa: ARG005
    "trimesh": lambda: SimpleNamespace(
        vertices=POINTS, vertex_normals=POINTS, visual=trimesh.PointCloud(POINTS, COLORS).visual
    ),
}


@pytest.mark.parametrize("library", CLOUDS)
def test_points_normals_and_colours_are_found(library: str) -> None:
    cloud = cleaned_cloud(CLOUDS[library]())
    np.testing.assert_allclose(cloud.points, POINTS)
    assert cloud.normals is not None
    np.testing.assert_allclose(cloud.normals, POINTS)
    colors, others = split_colors(cloud.attributes)
    assert colors is not None
    np.testing.assert_allclose(colors, COLORS / 255)
    assert set(others) == ({"return_number", "gps_time"} if library in {"PDAL", "pandas"} else set())


def test_empty_arrays_are_none() -> None:
    cloud = cleaned_cloud(SimpleNamespace(points=POINTS, normals=np.empty((0, 3)), colors=np.empty((0, 3))))
    assert cloud.normals is None
    assert not cloud.attributes


def test_vertices_of_meshes_are_points_and_invented_colours_are_not_taken() -> None:
    cloud = cleaned_cloud(trimesh.creation.icosphere(subdivisions=3))
    assert len(cloud.points) == 642
    assert not cloud.attributes
    assert "mesh" in cloud.notes[0]


def test_tensors_are_arrays_whatever_they_are_used_for() -> None:
    points = torch.tensor(POINTS, requires_grad=True)
    cloud = cleaned_cloud(points, points, points, {"label": torch.arange(600)})
    np.testing.assert_allclose(cloud.normals, cloud.points)
    np.testing.assert_array_equal(cloud.attributes["label"], np.arange(600))


@pytest.mark.parametrize(
    ("points", "said"),
    [
        (np.zeros(9, [("x", float), ("y", float)]), "points are a table: there are no columns x, y and z"),
        (SimpleNamespace(points=np.zeros((9, 2))), "points have shape"),
        (object(), "points are not numbers"),
        (SimpleNamespace(vertices=["a"]), "points are not numbers"),
    ],
)
def test_errors_name_the_argument(points: Any, said: str) -> None:
    with pytest.raises(UsageError, match=said):
        cleaned_cloud(points)


@pytest.fixture(scope="module")
def mesh() -> Reconstruction:
    attributes = {"colors": COLORS, "height": POINTS[:, 2]}
    return reconstruct(POINTS, POINTS, vertices=80, attributes=attributes)


def test_a_mesh_is_one_of_trimesh(mesh: Reconstruction) -> None:
    given = mesh.to_trimesh()
    np.testing.assert_array_equal(given.faces, mesh.faces)
    np.testing.assert_array_equal(given.visual.vertex_colors[:, 1], mesh.attributes["green"])
    np.testing.assert_array_equal(given.vertex_attributes["height"], mesh.attributes["height"])


def test_a_mesh_is_one_of_pyvista(mesh: Reconstruction) -> None:
    pytest.importorskip("pyvista")
    given = mesh.to_pyvista()
    np.testing.assert_array_equal(given.points, mesh.vertices)
    np.testing.assert_array_equal(given.regular_faces, mesh.faces)
    np.testing.assert_array_equal(given.point_data["RGB"][:, 0], mesh.attributes["red"])
    np.testing.assert_array_equal(given.point_data["height"], mesh.attributes["height"])
    assert cleaned_cloud(given).notes  # that it is a mesh


def test_a_mesh_is_one_of_open3d(mesh: Reconstruction) -> None:
    pytest.importorskip("open3d")
    given = mesh.to_open3d()
    np.testing.assert_array_equal(given.vertices, mesh.vertices)
    np.testing.assert_allclose(255 * np.asarray(given.vertex_colors)[:, 2], mesh.attributes["blue"])


def test_what_is_not_installed_is_named(mesh: Reconstruction, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "open3d", None)
    with pytest.raises(UsageError, match="no open3d") as told:
        mesh.to_open3d()
    assert told.value.hint == "pip install open3d"


def test_no_library_is_imported_unasked() -> None:
    loaded = "import sys, hdpea.reading.objects, hdpea.writing.objects; print(*sys.modules)"
    modules = subprocess.run([sys.executable, "-c", loaded], check=True, capture_output=True, text=True).stdout.split()
    assert not {"open3d", "trimesh", "pyvista", "pandas", "torch"} & set(modules)


def test_read_is_read_points() -> None:
    import hdpea

    assert hdpea.read is hdpea.read_points
