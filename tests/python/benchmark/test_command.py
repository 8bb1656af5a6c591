# SPDX-License-Identifier: GPL-3.0-or-later
"""Any program as a method: it gets the points, and what it writes is the mesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.worker import Task, run_method
from hdpea.errors import CannotReconstruct, UsageError

PROGRAM = """
import sys
from hdpea.reading import read_points
points, mesh, vertices = sys.argv[1:]
kept = read_points(points).points[: int(vertices)]
busy = [i * i for i in range(3_000_000)]  # some time, and 100 MB
with open(mesh, "w") as file:
    print("OFF", len(kept), len(kept) - 2, 0, file=file)
    for row in kept:
        print(*row, file=file)
    for i in range(2, len(kept)):
        print(3, 0, i - 1, i, file=file)
"""


@pytest.fixture
def cloud() -> Cloud:
    points = np.random.default_rng(0).normal(size=(50, 3))
    return Cloud(points, points / np.linalg.norm(points, axis=1, keepdims=True), "ball", "clean")


def task(cloud: Cloud, run: str, folder: Path) -> Task:
    return Task(cloud, "command", {"run": run, "format": ".off", "folder": str(folder)}, 5, folder)


def test_a_program_makes_the_mesh(cloud: Cloud, tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    made = run_method(task(cloud, "{python} program.py {points} {mesh} {vertices}", tmp_path))
    np.testing.assert_allclose(made.mesh[0], cloud.points[:5], atol=1e-6)
    assert made.mesh[1].tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    assert 0.05 < made.cpu_seconds < 10 * made.seconds
    assert made.peak_bytes > 100_000_000


def test_a_program_that_is_missing_is_told(cloud: Cloud, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="Cannot run no-such-program: No such file"):
        run_method(task(cloud, "no-such-program {points} {mesh}", tmp_path))


@pytest.mark.parametrize(
    ("run", "said"),
    [
        (
            "{python} -c 'import sys; sys.exit(\"too few points\")' {points} {mesh}",
            "ended with 1 and said: too few points",
        ),
        ("{python} -c pass {points} {mesh}", "ended with 0 and said: nothing"),
    ],
)
def test_what_a_program_says_when_it_fails_is_told(run: str, said: str, cloud: Cloud, tmp_path: Path) -> None:
    with pytest.raises(CannotReconstruct, match="made no mesh") as caught:
        run_method(task(cloud, run, tmp_path))
    assert said in caught.value.message
