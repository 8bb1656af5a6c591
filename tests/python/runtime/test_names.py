# SPDX-License-Identifier: GPL-3.0-or-later
"""The file that was probably meant."""

from __future__ import annotations

from pathlib import Path

import pytest

from hdpea.runtime.names import nearest_name


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("scann.xyz", "scan.xyz"),
        ("SCAN.XYZ", "scan.xyz"),
        ("scan", "scan.xyz"),
        ("part", "part.stl"),
        ("other.txt", None),
        ("folder", None),
    ],
)
def test_the_most_alike_name_of_the_folder(typed: str, meant: str | None, tmp_path: Path) -> None:
    for name in ("scan.xyz", "part.stl"):
        (tmp_path / name).touch()
    (tmp_path / "folder1").mkdir()
    assert nearest_name(tmp_path / typed) == (None if meant is None else tmp_path / meant)


def test_a_folder_that_is_missing_has_none(tmp_path: Path) -> None:
    assert nearest_name(tmp_path / "missing" / "scan.xyz") is None
