# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs are refused early, and are never half there."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest

from hdpea.errors import UsageError
from hdpea.runtime.outputs import check_output, remove_unfinished, replacing


def names_in(folder: Path) -> list[str]:
    return [each.name for each in folder.iterdir()]


def test_a_good_output_is_accepted_and_leaves_no_trace(tmp_path: Path) -> None:
    check_output(tmp_path / "mesh.OBJ", [".obj"])
    assert list(tmp_path.iterdir()) == []


def test_unknown_extension_names_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"\.obj, \.ply"):
        check_output(tmp_path / "mesh.docx", [".obj", ".ply"])


def test_missing_folder(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no folder"):
        check_output(tmp_path / "nowhere" / "mesh.obj", [".obj"])


def test_folder_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "mesh.obj").mkdir()
    with pytest.raises(UsageError, match="not a file"):
        check_output(tmp_path / "mesh.obj", [".obj"])


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="needs a folder that even root cannot write in")
def test_unwritable_folder() -> None:
    with pytest.raises(UsageError, match="/proc"):
        check_output(Path("/proc/mesh.obj"), [".obj"])


def test_the_old_file_stays_until_the_new_one_is_complete(tmp_path: Path) -> None:
    target = tmp_path / "mesh.obj"
    target.write_text("old")
    with replacing(target) as partial:
        partial.write_text("new")
        assert target.read_text() == "old"
    assert target.read_text() == "new"
    assert names_in(tmp_path) == ["mesh.obj"]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_an_error_leaves_the_old_file_and_nothing_else(tmp_path: Path, error: type[BaseException]) -> None:
    target = tmp_path / "mesh.obj"
    target.write_text("old")
    with suppress(error), replacing(target) as partial:
        partial.write_text("half")
        raise error
    assert target.read_text() == "old"
    assert names_in(tmp_path) == ["mesh.obj"]


def test_a_full_disk_is_one_clear_sentence(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="No space left"), replacing(tmp_path / "mesh.obj"):
        raise OSError(28, "No space left on device")


def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "link.obj").symlink_to(tmp_path / "real.obj")
    with replacing(tmp_path / "link.obj") as partial:
        partial.write_text("new")
    assert (tmp_path / "real.obj").read_text() == "new"


def test_ending_at_once_removes_what_is_half_written(tmp_path: Path) -> None:
    with suppress(UsageError), replacing(tmp_path / "mesh.obj") as partial:
        partial.write_text("half")
        remove_unfinished()
        assert names_in(tmp_path) == []
