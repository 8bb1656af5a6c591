# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from hdpea.errors import UsageError
from hdpea.options import Checked, MeshingOptions, Options, option
from hdpea.options.lengths import Length
from hdpea.options.settings import as_dict, options_from, settings


@dataclass(frozen=True)
class _Shared(Checked):
    share: float = option(0.5, "a share", minimum=0, maximum=1)


def test_defaults_are_legal_and_the_same_from_everywhere() -> None:
    assert options_from({}) == Options()
    assert options_from({each.name: each.default for each in settings()}) == Options()


def test_names_are_unique_so_that_flags_and_config_keys_can_be_flat() -> None:
    names = [each.name for each in settings()]
    assert len(names) == len(set(names))


def test_every_setting_is_explained() -> None:
    assert all(each.help for each in settings())


def test_settings_land_in_their_stage() -> None:
    options = options_from({"vertices": 500, "fill_holes": Length(1, percent=True), "threads": 2})
    assert options.meshing == MeshingOptions(vertices=500, fill_holes=Length(1, percent=True))
    assert options.threads == 2


def test_report_shows_lengths_as_the_user_writes_them() -> None:
    options = options_from({"fill_holes": Length(1, percent=True)})
    assert as_dict(options)["meshing"]["fill_holes"] == "1%"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("normals", "guess"),
        ("normal_neighbors", 2),
        ("orient", "guess"),
        ("metric_scale", float("nan")),
        ("max_stretch", 0.5),
        ("vertices", 3),
        ("seed", -1),
        ("threads", -1),
    ],
)
def test_illegal_values_are_refused(name: str, value: Any) -> None:
    with pytest.raises(UsageError, match=name):
        options_from({name: value})


@pytest.mark.parametrize("share", [-0.1, 1.1, float("nan")])
def test_values_have_a_maximum_too(share: float) -> None:
    with pytest.raises(UsageError, match="`share` is"):
        _Shared(share)


def test_vertices_and_faces_exclude_each_other() -> None:
    with pytest.raises(UsageError, match="exclude"):
        MeshingOptions(vertices=100, faces=200)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"vertices": 99_999_999_999_999_999_999}, "at most"),
        ({"vertices": "many"}, "whole number"),
        ({"vertices": 20.5}, "whole number"),
        ({"rounds": 10**9}, "at most"),
        ({"metric_scale": "large"}, "is a number"),
        ({"metric_scale": float("nan")}, "is a number"),
    ],
)
def test_numbers_that_are_none_or_absurd_are_refused(wrong: dict[str, object], said: str) -> None:
    with pytest.raises(UsageError, match=said):
        options_from(wrong)
