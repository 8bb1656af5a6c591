# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that are left out: told by every command, and written with the reason."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from hdpea.cli import run
from hdpea.reading import read_points

Capture = pytest.CaptureFixture[str]


@pytest.mark.parametrize("name", ["dropped.ply", "dropped.npz"])
def test_what_was_dropped_is_written_with_the_reason(name: str, scan_with_strays: str, tmp_path: Path) -> None:
    assert run(["reconstruct", scan_with_strays, str(tmp_path / "m.obj"), "--dropped", str(tmp_path / name)]) == 0
    dropped = read_points(tmp_path / name)
    assert [9, 0, 0] in dropped.points.tolist()
    assert [0, 7, 0] in dropped.points.tolist()
    assert set(dropped.attributes["reason"].tolist()) == {1}


def test_a_file_of_dropped_points_may_be_empty(scan: str, tmp_path: Path) -> None:
    arguments = ["reconstruct", scan, str(tmp_path / "m.obj"), "--outliers", "none"]
    assert run([*arguments, "--dropped", str(tmp_path / "dropped.ply")]) == 0
    assert b"element vertex 0" in (tmp_path / "dropped.ply").read_bytes()


def test_dropped_points_never_take_the_place_of_the_input(
    scan_with_strays: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    (tmp_path / "soft.npz").symlink_to(scan_with_strays)
    command = ["reconstruct", scan_with_strays, tmp_path / "m.obj", "--dropped"]
    assert "both input and output" in failed(2, *command, tmp_path / "soft.npz")
    assert "not one of .npz, .ply" in failed(2, *command, tmp_path / "dropped.xyz")


@pytest.mark.parametrize("command", ["embed", "curvature"])
def test_other_commands_leave_strays_out_and_say_so(
    command: str, scan_with_strays: str, tmp_path: Path, capsys: Capture
) -> None:
    def written(*flags: str) -> int:
        assert run([command, scan_with_strays, str(tmp_path / "out.npz"), *flags]) == 0
        return len(np.load(tmp_path / "out.npz")["points"])

    assert written() <= 800
    assert "lie on no surface" in capsys.readouterr().err
    assert written("--outliers", "none") == 802
    assert "lie on no surface" not in capsys.readouterr().err
