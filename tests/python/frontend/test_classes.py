# SPDX-License-Identifier: GPL-3.0-or-later
"""A part of a cloud, by the classes of its points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from helpers.clouds import sphere_points

from hdpea.errors import UsageError
from hdpea.frontend.cleaning import surface_cloud
from hdpea.options import Classes, CleaningOptions
from hdpea.reading.cloud import PointCloud

LABELS = np.arange(300) % 3 + 1


def taken(classes: Classes, **attributes: Any) -> PointCloud:
    options = CleaningOptions("none", classes)
    return surface_cloud(PointCloud(sphere_points(300), attributes=attributes), options).cloud


@pytest.mark.parametrize("name", ["classification", "Classification", "scalar_Classification", "label"])
@pytest.mark.parametrize("dtype", [np.uint8, np.int64, np.float64])
def test_only_the_points_of_the_classes_are_taken(name: str, dtype: type) -> None:
    cloud = taken(Classes((1, 3)), **{name: LABELS.astype(dtype)})
    np.testing.assert_array_equal(cloud.points, sphere_points(300)[LABELS != 2])
    assert any("200 of 300 points" in note for note in cloud.notes)


def test_classes_that_are_not_there_are_told_from_those_that_are() -> None:
    with pytest.raises(UsageError, match="No point is of the `classes` 9") as told:
        taken(Classes((9,)), classification=LABELS)
    assert "1, 2, 3" in told.value.hint


def test_a_cloud_without_classes_has_none_to_choose_from() -> None:
    with pytest.raises(UsageError, match=r"no classification \(attributes: height\)"):
        taken(Classes((9,)), height=LABELS / 7)


@pytest.mark.parametrize("given", ["2,6", [2, 6], (2, 6), np.array([2, 6]), Classes((2, 6))])
def test_classes_are_given_in_any_way(given: Any) -> None:
    assert Classes.of(given) == Classes((2, 6))
    assert str(Classes.of(given)) == "2,6"


@pytest.mark.parametrize("given", ["", "2,x", [], [2.5], None])
def test_what_is_no_list_of_classes_is_refused(given: Any) -> None:
    with pytest.raises(UsageError, match="`classes` are whole numbers"):
        Classes.of(given)
