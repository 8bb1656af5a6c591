# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that are made once, for all that is made of them."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from helpers import clouds

from hdpea.benchmark import methods
from hdpea.benchmark.measured_mesh import MeasuredMesh
from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.options import PoissonOptions
from hdpea.benchmark.surface_cache import cached_surface

CLOUD = Cloud(*clouds.sphere(100), "ball", "clean")


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The depths that the method `counted` was called with."""
    called: list[int] = []
    module = ModuleType(f"{methods.__name__}.counted")

    def surface(cloud: Cloud, options: PoissonOptions) -> tuple[np.ndarray, np.ndarray]:
        called.append(options.depth)
        return cloud.points, np.array([[0, 1, 2]])

    vars(module)["surface"] = surface
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setitem(methods.METHODS, "counted", methods.Method("counted", PoissonOptions))
    return called


def made(folder: Path, cloud: Cloud = CLOUD, depth: int = 8, reduce: str = "fast") -> MeasuredMesh:
    return cached_surface(cloud, "counted", PoissonOptions(reduce=reduce, depth=depth), folder)


def test_a_surface_is_made_once_for_all_reductions(tmp_path: Path, calls: list[int]) -> None:
    first, second = made(tmp_path), made(tmp_path, reduce="cvt")
    assert calls == [8]
    assert (first.seconds, first.cpu_seconds, first.peak_bytes) == (
        second.seconds,
        second.cpu_seconds,
        second.peak_bytes,
    )
    for one, other in zip(first.mesh, second.mesh, strict=True):
        np.testing.assert_array_equal(one, other)


def test_other_options_or_points_make_another(tmp_path: Path, calls: list[int]) -> None:
    made(tmp_path)
    made(tmp_path, depth=6)
    made(tmp_path, replace(CLOUD, points=CLOUD.points + 1))
    made(tmp_path, replace(CLOUD, normals=-CLOUD.normals))
    assert calls == [8, 6, 8, 8]


def test_half_a_file_is_made_again(tmp_path: Path, calls: list[int]) -> None:
    made(tmp_path)
    (path,) = tmp_path.iterdir()
    path.write_bytes(path.read_bytes()[:100])
    made(tmp_path)
    assert calls == [8, 8]


def test_what_two_steps_take_is_added_but_for_their_memory() -> None:
    mesh = (np.zeros((3, 3)), np.array([[0, 1, 2]]))
    both = MeasuredMesh(mesh, 1.0, 2.0, 300).then(MeasuredMesh(mesh, 10.0, 20.0, 200))
    assert (both.seconds, both.cpu_seconds, both.peak_bytes) == (11.0, 22.0, 300)
