# SPDX-License-Identifier: GPL-3.0-or-later
"""The estimates hold where they were measured."""

from __future__ import annotations

import pytest

from hdpea.report.cost import (
    PEAK_BYTES,
    PROCESSOR_SECONDS,
    TILED_WHOLE_BYTES,
    seconds_of_run,
    tiled_vertices_within,
)

# Points (with normals), vertices, processor seconds of the whole command, peak memory in MB.
MEASURED = [
    (10_000, 1_250, 3.6, 291),
    (10_000, 4_000, 4.7, 293),
    (40_000, 5_000, 6.5, 347),
    (40_000, 15_000, 9.3, 364),
    (100_000, 12_500, 11.7, 492),
    (250_000, 10_000, 22.0, 889),
    (250_000, 31_250, 27.7, 888),
    (1_000_000, 100_000, 130.5, 3064),
]


@pytest.mark.parametrize(("points", "vertices", "seconds", "megabytes"), MEASURED)
def test_estimates_are_within_a_tenth_of_what_was_measured(
    points: int, vertices: int, seconds: float, megabytes: float
) -> None:
    assert PROCESSOR_SECONDS.of(points, vertices) == pytest.approx(seconds, rel=0.1)
    assert PEAK_BYTES.of(points, vertices) == pytest.approx(1e6 * megabytes, rel=0.1)


def test_a_cloud_that_must_be_oriented_takes_longer_the_larger_it_is() -> None:
    extra = [seconds_of_run(n, 1000, oriented=False) - seconds_of_run(n, 1000, oriented=True) for n in (0, 1000, 10**5)]
    assert extra[0] == 0
    assert 0 < 100 * extra[1] < extra[2]


@pytest.mark.parametrize(("memory", "none"), [(0.2e9, True), (4e9, False)])
def test_the_largest_mesh_of_tiles_takes_the_memory_that_there_is(memory: float, none: bool) -> None:
    most = tiled_vertices_within(memory)
    assert (most == 0) == none
    assert most == 0 or TILED_WHOLE_BYTES.of(0, most) == pytest.approx(memory, rel=1e-4)
