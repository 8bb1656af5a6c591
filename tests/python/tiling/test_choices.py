# SPDX-License-Identifier: GPL-3.0-or-later
"""What tiles choose each by itself is told as one."""

from __future__ import annotations

from hdpea.options.choice import Choice
from hdpea.tiling.choices import merged

FEW, MANY = Choice("denoise_neighbors", 120, "points", "a little"), Choice("denoise_neighbors", 160, "points", "rough")
NONE, MLS = Choice("denoise", "none", "", "smooth"), Choice("denoise", "mls", "", "rough")


def test_what_all_tiles_chose_alike_is_told_as_it_is() -> None:
    assert merged([[FEW], [FEW]], [10, 20]) == [FEW]
    assert merged([[], []], [10, 20]) == []


def test_numbers_that_differ_are_told_by_their_range() -> None:
    (choice,) = merged([[FEW], [MANY], []], [10, 20, 30])
    assert (choice.value, choice.unit, choice.why) == (
        "120 to 160",
        "points",
        "tiles differ; in the largest tile rough",
    )


def test_of_methods_that_differ_that_of_most_points_is_told() -> None:
    (choice,) = merged([[NONE], [MLS], [NONE]], [20, 30, 20])
    assert choice == Choice("denoise", "none", "", "in tiles with 57% of the points, of which the largest: smooth")
