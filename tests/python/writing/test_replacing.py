# SPDX-License-Identifier: GPL-3.0-or-later
"""What lies beside a mesh is somebody's, too: nothing that hdpea did not make is replaced, and nothing half-written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers import clouds
from helpers.meshes import TETRAHEDRON_FACES, tetrahedron

from hdpea import Reconstruction, reconstruct
from hdpea.errors import UsageError
from hdpea.options import MeshingOptions, Options
from hdpea.reading.cloud import PointCloud
from hdpea.writing.meshes import write_mesh


@pytest.fixture(scope="module")
def textured() -> Reconstruction:
    points, normals = clouds.sphere(500)
    attributes = {name: np.full(500, 99, np.uint8) for name in ("red", "green", "blue")}
    cloud = PointCloud(points, normals, attributes, crs="EPSG:25832")
    options = Options(meshing=MeshingOptions(vertices=100, lod=2), texture=64)
    return reconstruct(cloud, options=options)


@pytest.mark.parametrize("beside", ["mtl", "texture.png", "obj.world.json", "lod1.obj", "lod1.obj.world.json"])
def test_a_file_beside_is_kept_and_no_mesh_written(textured: Reconstruction, beside: str, tmp_path: Path) -> None:
    own = tmp_path / f"mesh.{beside}"
    own.write_text("somebody's own")
    with pytest.raises(UsageError, match=f"{own.name} exists"):
        textured.write(tmp_path / "mesh.obj")
    assert [each.read_text() for each in tmp_path.iterdir()] == ["somebody's own"]
    textured.write(tmp_path / "mesh.obj", force=True)
    textured.write(tmp_path / "mesh.obj")
    assert own.stat().st_size > len("somebody's own")


def test_where_a_mesh_lies_takes_no_file_of_others(tmp_path: Path) -> None:
    own = tmp_path / "mesh.obj.world.json"
    own.write_text("somebody's own")
    with pytest.raises(UsageError, match="no placement that hdpea made"):
        write_mesh(tmp_path / "mesh.obj", tetrahedron(), TETRAHEDRON_FACES, crs="EPSG:25832")
    assert not (tmp_path / "mesh.obj").exists()
    write_mesh(tmp_path / "mesh.obj", tetrahedron(), TETRAHEDRON_FACES)
    assert own.read_text() == "somebody's own"
