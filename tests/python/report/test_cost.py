# SPDX-License-Identifier: GPL-3.0-or-later
"""The estimates hold where they were measured."""

from __future__ import annotations

import pytest

from hdpea.report.cost import (
    PEAK_BYTES,
    PROCESSOR_SECONDS,
    TILED_WHOLE_BYTES,
    tiled_vertices_within,
)

# Points, vertices, processor seconds of the whole command, peak memory in MB.
WITH_NORMALS = [
    (10_000, 1_250, 4.7, 294),
    (10_000, 4_000, 4.6, 299),
    (40_000, 5_000, 7.6, 358),
    (40_000, 15_000, 10.2, 359),
    (100_000, 12_500, 13.6, 483),
    (250_000, 10_000, 25.3, 856),
    (250_000, 31_250, 30.2, 857),
    (1_000_000, 100_000, 127.9, 2861),
]
WITHOUT_NORMALS = [
    (10_000, 1_250, 4.6, 296),
    (40_000, 5_000, 9.3, 361),
    (100_000, 12_500, 17.3, 480),
    (250_000, 31_250, 31.8, 853),
    (1_000_000, 100_000, 115.8, 2788),
]


@pytest.mark.parametrize(
    ("points", "vertices", "seconds", "megabytes", "within"),
    [(*run, 0.1) for run in WITH_NORMALS] + [(*run, 0.2) for run in WITHOUT_NORMALS],
)
def test_estimates_are_near_what_was_measured(
    points: int, vertices: int, seconds: float, megabytes: float, within: float
) -> None:
    assert PROCESSOR_SECONDS.of(points, vertices) == pytest.approx(seconds, rel=within)
    assert PEAK_BYTES.of(points, vertices) == pytest.approx(1e6 * megabytes, rel=0.1)


@pytest.mark.parametrize(("memory", "none"), [(0.2e9, True), (4e9, False)])
def test_the_largest_mesh_of_tiles_takes_the_memory_that_there_is(memory: float, none: bool) -> None:
    most = tiled_vertices_within(memory)
    assert (most == 0) == none
    assert most == 0 or TILED_WHOLE_BYTES.of(0, most) == pytest.approx(memory, rel=1e-4)
