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
    (10_000, 1_250, 3.8, 298),
    (10_000, 4_000, 4.4, 299),
    (40_000, 5_000, 6.2, 354),
    (40_000, 15_000, 8.0, 363),
    (100_000, 12_500, 11.9, 478),
    (250_000, 10_000, 22.7, 858),
    (250_000, 31_250, 25.8, 857),
    (1_000_000, 100_000, 117.5, 2862),
    (4_000_000, 500_000, 661.0, 11250),
]
WITHOUT_NORMALS = [
    (10_000, 1_250, 3.7, 297),
    (40_000, 5_000, 8.2, 360),
    (100_000, 12_500, 13.8, 485),
    (250_000, 31_250, 27.8, 860),
    (1_000_000, 100_000, 104.3, 2830),
]


@pytest.mark.parametrize(
    ("points", "vertices", "seconds", "megabytes", "within"),
    [(*run, 0.1) for run in WITH_NORMALS] + [(*run, 0.21) for run in WITHOUT_NORMALS],
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
