# SPDX-License-Identifier: GPL-3.0-or-later
"""What must not change the mesh: threads, a second run, units and place."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from helpers import clouds
from numpy.typing import NDArray

from hdpea import reconstruct
from hdpea.options import MeshingOptions, Options

POINTS, VERTICES = 4000, 400

# One run in a process of its own, where hashing and addresses differ; prints a digest of the mesh.
RUN = """
import hashlib, sys
import numpy as np
from hdpea import reconstruct
from hdpea.options import MeshingOptions, Options
cloud = np.load(sys.argv[1])
options = Options(meshing=MeshingOptions(vertices=int(sys.argv[2])), threads=int(sys.argv[3]))
mesh = reconstruct(cloud["points"], cloud["normals"], options=options)
print(hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).hexdigest())
"""


def mesh_of(points: NDArray[np.float64], normals: NDArray[np.float64] | None, threads: int = 0) -> Any:
    return reconstruct(points, normals, options=Options(meshing=MeshingOptions(vertices=VERTICES), threads=threads))


def same_bytes(one: Any, other: Any) -> bool:
    return one.vertices.tobytes() == other.vertices.tobytes() and one.faces.tobytes() == other.faces.tobytes()


@pytest.mark.parametrize("with_normals", [True, False])
def test_any_number_of_threads_gives_the_same_bytes(with_normals: bool) -> None:
    points, normals = clouds.torus(POINTS)
    given = normals if with_normals else None
    once = mesh_of(points, given, threads=1)
    for threads in (2, 4):
        assert same_bytes(once, mesh_of(points, given, threads=threads)), f"{threads} threads differ from one"


def test_two_runs_give_the_same_bytes() -> None:
    assert same_bytes(mesh_of(*clouds.torus(POINTS)), mesh_of(*clouds.torus(POINTS)))


@pytest.mark.slow
def test_other_processes_give_the_same_bytes(tmp_path: Any) -> None:
    points, normals = clouds.torus(POINTS)
    np.savez(tmp_path / "cloud.npz", points=points, normals=normals)

    def digest(threads: int) -> str:
        command = [sys.executable, "-c", RUN, str(tmp_path / "cloud.npz"), str(VERTICES), str(threads)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    assert len({digest(threads) for threads in (1, 2, 4, 4)}) == 1


@pytest.mark.parametrize(("scale", "shift"), [(1000.0, 0.0), (1.0, 1e6), (1000.0, 1e6)])
@pytest.mark.parametrize("shape", [clouds.torus, clouds.box, clouds.cylinder])
def test_units_and_place_give_the_same_mesh(shape: Callable[[int], clouds.Cloud], scale: float, shift: float) -> None:
    points, normals = shape(POINTS)
    here, there = mesh_of(points, normals), mesh_of(scale * points + shift, normals)
    np.testing.assert_array_equal(here.faces, there.faces)
    # Doubles near the shift have steps of 1e-10, which the mesh may show, enlarged a little by the optimisation.
    assert np.abs((there.vertices - shift) / scale - here.vertices).max() < 1e-6 * here.report.distances.spacing
