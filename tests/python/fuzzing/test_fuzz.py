# SPDX-License-Identifier: GPL-3.0-or-later
"""A few hundred random cases of each kind; ``make fuzz`` runs as many as asked for."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from helpers.fuzzing import clouds, commands, core, files
from helpers.fuzzing.mesh_checker import faults

from hdpea import reconstruct
from hdpea.runtime.processes import run_isolated

CLOUDS, FILES, COMMANDS, CALLS, AT_ONCE = 240, 400, 80, 400, 40


@pytest.mark.parametrize("first", range(0, CLOUDS, AT_ONCE))
def test_any_cloud_gives_a_true_mesh_or_a_documented_error(first: int) -> None:
    endings = [clouds.run(seed) for seed in range(first, first + AT_ONCE)]
    assert "mesh" in endings
    assert set(endings) <= {"mesh", "mesh, missed", "CannotReconstruct", "UsageError", "UnreadableInput"}


@pytest.mark.parametrize("first", range(0, FILES, AT_ONCE))
def test_any_damaged_file_gives_a_clean_cloud_or_says_what_is_wrong(first: int) -> None:
    assert {files.run(seed) for seed in range(first, first + AT_ONCE)} <= {"cloud", "UnreadableInput"}


@pytest.mark.parametrize("first", range(0, COMMANDS, AT_ONCE))
def test_any_command_ends_as_documented(first: int) -> None:
    assert {commands.run(seed) for seed in range(first, first + AT_ONCE)} <= set(commands.CODES.values())


def test_any_call_of_the_core_gives_a_result_or_is_refused() -> None:
    # In a process of its own, which a crash would end.
    failed = {each.index: each.failed for each in run_isolated(core.run, range(CALLS), 1, 120) if each.failed}
    assert failed == {}


def test_the_checker_sees_what_is_wrong() -> None:
    points = sphere_points(800)
    made = reconstruct(points, vertices=100)
    report = made.report.as_dict()
    assert faults(made.vertices, made.faces, points, report) == []
    broken = {
        "same direction": (made.vertices, np.vstack([made.faces, made.faces[:1]])),
        "does not exist": (made.vertices, made.faces + len(made.vertices)),
        "not finite": (np.where(made.vertices == made.vertices[3], np.nan, made.vertices), made.faces),
        "far outside": (made.vertices * 9, made.faces),
        "closed": (made.vertices, made.faces[1:]),
        "other vertices": (np.vstack([made.vertices, points[:1]]), made.faces),
    }
    for said, (vertices, faces) in broken.items():
        assert said in "; ".join(faults(vertices, faces, points, report))
