# SPDX-License-Identifier: GPL-3.0-or-later
"""The estimates hold where they were measured."""

from __future__ import annotations

import pytest

from hdpea.report.cost import PEAK_BYTES, SECONDS, seconds_of_run

# Points (with normals), vertices, seconds of the whole command on two cores, peak memory in MB.
MEASURED = [
    (10_000, 1_250, 2.7, 255),
    (10_000, 5_000, 4.3, 288),
    (40_000, 1_000, 4.0, 293),
    (40_000, 5_000, 5.3, 315),
    (40_000, 20_000, 12.7, 383),
    (100_000, 2_000, 9.1, 361),
    (100_000, 12_500, 12.5, 419),
    (250_000, 5_000, 26.3, 395),
    (250_000, 31_250, 49.1, 681),
]


@pytest.mark.parametrize(("points", "vertices", "seconds", "megabytes"), MEASURED)
def test_estimates_are_within_a_third_of_what_was_measured(
    points: int, vertices: int, seconds: float, megabytes: float
) -> None:
    assert SECONDS.of(points, vertices) == pytest.approx(seconds, rel=0.33)
    assert PEAK_BYTES.of(points, vertices) == pytest.approx(1e6 * megabytes, rel=0.33)


def test_a_cloud_that_must_be_oriented_takes_longer_the_larger_it_is() -> None:
    extra = [seconds_of_run(n, 1000, oriented=False) - seconds_of_run(n, 1000, oriented=True) for n in (0, 1000, 10**5)]
    assert extra[0] == 0
    assert 0 < 100 * extra[1] < extra[2]
