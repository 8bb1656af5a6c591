# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipes do what they say, on small clouds that look as those of the programs do."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
import trimesh
from helpers import clouds
from plyfile import PlyData, PlyElement

from hdpea import read_points
from hdpea.reading.triangle_mesh import parse_triangle_mesh

ROOT = Path(__file__).parents[2]
RECIPES = (ROOT / "docs/recipes.md").read_text()
COUNT = 1500
QUICK = str(Path(__file__).parent / "helpers/standins.py")
"""The command with a stand-in for the reconstruction, where it is the script that is tested."""

pytestmark = pytest.mark.slow


def recipe(title: str, language: str = "sh") -> list[str]:
    """Return the blocks of a recipe."""
    section = RECIPES.split(f"## {title}\n")[1].split("\n## ")[0]
    return re.findall(rf"```{language}\n(.*?)```", section, re.DOTALL)


def in_shell(command: str, folder: Path, hdpea: str = "-m hdpea") -> str:
    """Run a block as it is: `hdpea`, `python` and the examples are commands there."""
    programs = folder / "programs"
    programs.mkdir(exist_ok=True)
    for name, module in {"hdpea": hdpea, "python": ""}.items():
        (programs / name).write_text(f'#!/bin/sh\nexec "{sys.executable}" {module} "$@"\n')
        (programs / name).chmod(0o755)
    paths = os.pathsep.join([str(programs), str(ROOT / "examples"), os.environ["PATH"]])
    command = command.replace("python ", f"python {ROOT}/examples/")
    environment = {**os.environ, "PATH": paths}
    shell = ["/bin/sh", "-ec", command]
    ran = subprocess.run(shell, cwd=folder, env=environment, capture_output=True, text=True, check=True)
    return ran.stdout


def write_cloud(path: Path, **columns: Any) -> None:
    """Write a PLY of a torus, as single precision, with normals and more columns."""
    points, normals = clouds.torus(COUNT)
    named = (
        dict(zip(["x", "y", "z", "nx", "ny", "nz"], np.hstack([points, normals]).astype("f4").T, strict=True)) | columns
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    table = np.rec.fromarrays(list(named.values()), names=list(named))
    PlyData([PlyElement.describe(table, "vertex")]).write(path)


def painted(path: Path) -> None:
    write_cloud(path, **{name: np.full(COUNT, value, np.uint8) for name, value in RED.items()})


RED = {"red": 200, "green": 20, "blue": 10}


def colors_in(path: Path) -> set[tuple[int, ...]]:
    attributes = read_points(path).attributes
    return set(zip(*(attributes[name].tolist() for name in RED), strict=True))


ONE_CLOUD, ALL_PROJECTS, OF_A_FOLDER = recipe("COLMAP, every night")


def test_colmap(tmp_path: Path) -> None:
    painted(tmp_path / "dense/fused.ply")
    in_shell(ONE_CLOUD, tmp_path)
    assert colors_in(tmp_path / "dense/mesh.ply") == {(200, 20, 10)}
    assert json.loads((tmp_path / "dense/mesh.json").read_text())["mesh"]["genus"] == 1
    painted(tmp_path / "clouds/church.ply")
    assert not in_shell(OF_A_FOLDER, tmp_path, QUICK)
    assert json.loads((tmp_path / "made.jsonl").read_text())["exit_code"] == 0


def test_every_colmap_project(tmp_path: Path) -> None:
    script = ALL_PROJECTS.strip()
    assert _exit_code(script, tmp_path) == 2  # there are none
    painted(tmp_path / "projects/church/dense/fused.ply")
    (made,) = in_shell(script, tmp_path, QUICK).split()
    assert re.fullmatch(r"meshes/church-\d{4}-\d\d-\d\d\.ply", made)
    assert not in_shell(script, tmp_path, QUICK)  # it is done
    (tmp_path / "projects/tower/dense").mkdir(parents=True)
    assert _exit_code(script, tmp_path) == 1  # there is no cloud
    (tmp_path / "projects/tower/dense/fused.ply").write_bytes(b"ply\n")
    assert _exit_code(script, tmp_path) == 1
    assert [each.name for each in (tmp_path / "meshes").glob("*.ply")] == [Path(made).name]
    painted(tmp_path / "projects/tower/dense/fused.ply")
    for _ in range(2):  # it is tried again, since the stand-in's mesh has a hole
        assert _exit_code(script + " --watertight", tmp_path) == 1
        assert [each.name[:5] for each in (tmp_path / "meshes").glob("*.bad.ply")] == ["tower"]


def _exit_code(command: str, folder: Path) -> int:
    with pytest.raises(subprocess.CalledProcessError) as failed:
        in_shell(command, folder, QUICK)
    return int(failed.value.returncode)


def test_cloudcompare_and_meshlab(tmp_path: Path) -> None:
    (command,) = recipe("CloudCompare and MeshLab, there and back")
    fields = {
        "scalar_Intensity": np.full(COUNT, 0.25, np.float32),
        "scalar_Classification": np.full(COUNT, 6, np.float32),
    }
    write_cloud(
        tmp_path / "cloud.ply", **{name: np.full(COUNT, value, np.uint8) for name, value in RED.items()}, **fields
    )
    in_shell(command, tmp_path)
    vertex = PlyData.read(tmp_path / "mesh.ply")["vertex"]
    assert [each.val_dtype for each in vertex.properties[3:]] == ["u1", "u1", "u1", "f4", "f4"]
    np.testing.assert_allclose(vertex["scalar_Intensity"], 0.25, rtol=1e-6)
    assert set(vertex["scalar_Classification"]) == {6}
    assert colors_in(tmp_path / "mesh.ply") == {(200, 20, 10)}


def test_pdal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """PDAL itself is no Python package alone: what it would return stands in for it."""
    points, normals = clouds.torus(COUNT)
    names = ["X", "Y", "Z", "NormalX", "NormalY", "NormalZ", "Intensity", "Red", "Green", "Blue", "GpsTime"]
    colors = [np.full(COUNT, 257 * value, np.uint16) for value in RED.values()]
    columns = [*(points + 5e5).T, *normals.T, np.full(COUNT, 700, np.uint16), *colors, np.full(COUNT, 1e9)]

    class Pipeline:
        arrays = [np.rec.fromarrays(columns, names=names).view(np.ndarray)]  # noqa: RUF012

        def __or__(self, _: object) -> Pipeline:
            return self

        def execute(self) -> None:
            pass

    pdal = ModuleType("pdal")
    pdal.Reader, pdal.Filter = lambda _: Pipeline(), SimpleNamespace(range=lambda limits: limits)  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "pdal", pdal)
    monkeypatch.chdir(tmp_path)
    (program,) = recipe("PDAL", "python")
    exec(compile(program, "recipes.md", "exec"), {})  # noqa: S102 it is our own
    mesh = read_points(tmp_path / "ground.ply")
    assert colors_in(tmp_path / "ground.ply") == {(200, 20, 10)}
    assert {"intensity", "gps_time"} <= set(mesh.attributes)
    assert abs(mesh.points - 5e5).max() < 1.5


def test_blender_and_the_web(tmp_path: Path) -> None:
    command, _ = recipe("Blender, and the web")  # gltfpack is of npm
    painted(tmp_path / "statue.ply")
    in_shell(command, tmp_path)
    vertices, _ = parse_triangle_mesh(tmp_path / "statue.glb")
    assert np.ptp(vertices, axis=0).argmin() == 2  # the torus lies flat
    raw = trimesh.load(tmp_path / "statue.glb", force="mesh")
    assert np.ptp(raw.vertices, axis=0).argmin() == 1  # and in the file y is up
    assert len(raw.faces) == 300


def test_printing(tmp_path: Path) -> None:
    (commands,) = recipe("3D printing")
    points, _ = clouds.sphere(COUNT)
    np.savetxt(tmp_path / "points.txt", points[points[:, 2] > -0.7])  # it stood on something
    in_shell(commands, tmp_path)
    part = trimesh.load(tmp_path / "part.stl")
    assert part.is_watertight
    assert -0.9 < part.bounds[0, 2] < -0.7
    assert (tmp_path / "part.html").stat().st_size > 1e5


def test_terrain(tmp_path: Path) -> None:
    (command,) = recipe("Terrain for QGIS")
    points, _ = clouds.plane(COUNT)
    points = 40 * points + np.array([4e5, 5e6, 0])
    ground = points[:, 0] > 4e5 + 5
    hills = np.sin((points[:, 0] - 4e5) / 8)
    table = np.rec.fromarrays(
        [*points[:, :2].T, np.where(ground, hills, 9), np.where(ground, 2, 5).astype("u1")],
        names=["x", "y", "z", "classification"],
    )
    PlyData([PlyElement.describe(table, "vertex")]).write(tmp_path / "tile.ply")
    assert "of them known" in in_shell(command, tmp_path)
    head = dict(line.split() for line in (tmp_path / "terrain.asc").read_text().splitlines()[:6])
    grid = np.loadtxt(tmp_path / "terrain.asc", skiprows=6)
    assert grid.shape == (int(head["nrows"]), int(head["ncols"]))
    x = float(head["xllcorner"]) - 4e5 + np.arange(grid.shape[1]) + 0.5
    known = grid != float(head["nodata_value"])
    assert known.mean() > 0.9
    assert abs(grid - np.sin(x / 8))[known].max() < 0.1


def test_other_libraries(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (program,) = recipe("trimesh, Open3D, PyVista", "python")
    painted(tmp_path / "statue.ply")
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "recipes.md", "exec"), {})  # noqa: S102 it is our own
    assert len(read_points(tmp_path / "statue.off").points) == 200


def test_every_recipe_is_run() -> None:
    tested = re.findall(r'recipe\("(.*?)"', Path(__file__).read_text())
    assert re.findall(r"^## (.*)", RECIPES, re.MULTILINE) == tested
