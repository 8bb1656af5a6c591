# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs are refused early, and are never half there."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest

from hdpea.errors import UsageError
from hdpea.runtime.outputs import check_distinct, check_output, check_outside, remove_unfinished, replacing


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


def test_links_in_a_circle_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.obj").symlink_to(tmp_path / "b.obj")
    (tmp_path / "b.obj").symlink_to(tmp_path / "a.obj")
    with pytest.raises(UsageError, match="symbolic links"):
        check_output(tmp_path / "a.obj", [".obj"])
    check_distinct([tmp_path / "a.obj"], [tmp_path / "c.obj"])


def test_a_link_to_a_folder_that_is_not_there_is_refused(tmp_path: Path) -> None:
    (tmp_path / "link.obj").symlink_to(tmp_path / "nowhere" / "real.obj")
    with pytest.raises(UsageError, match=r"no folder .*nowhere"):
        check_output(tmp_path / "link.obj", [".obj"])


def test_names_may_be_as_long_as_the_system_allows(tmp_path: Path) -> None:
    longest = tmp_path / f"{'a' * 251}.obj"
    check_output(longest, [".obj"])
    with replacing(longest) as partial:
        partial.write_text("new")
    assert longest.read_text() == "new"
    with pytest.raises(UsageError, match="too long"):
        check_output(tmp_path / f"{'a' * 252}.obj", [".obj"])


@pytest.mark.parametrize("link", ["same", "hard", "symbolic"])
def test_an_output_may_not_be_an_input_under_any_name(tmp_path: Path, link: str) -> None:
    (source := tmp_path / "scan.ply").write_text("points")
    output = tmp_path / "out.ply"
    if link == "same":
        output = tmp_path / ".." / tmp_path.name / "scan.ply"
    elif link == "hard":
        output.hardlink_to(source)
    else:
        output.symlink_to(source)
    with pytest.raises(UsageError, match="both input and output"):
        check_distinct([None, source], [None, tmp_path / "other.ply", output])


def test_two_outputs_may_not_be_one_file(tmp_path: Path) -> None:
    (tmp_path / "link.json").symlink_to(tmp_path / "mesh.json")
    with pytest.raises(UsageError, match="the same output"):
        check_distinct([], [tmp_path / "mesh.json", tmp_path / "link.json"])
    check_distinct([], [tmp_path / "mesh.json", tmp_path / "mesh.obj", None, None])


def test_inputs_may_not_lie_where_a_folder_is_filled(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="which is the output"):
        check_outside(tmp_path / "meshes", [tmp_path / "meshes" / "cow.ply"])
    check_outside(tmp_path / "meshes", [tmp_path / "meshes2" / "cow.ply", None])


def test_the_partial_file_has_the_extension_in_lower_case(tmp_path: Path) -> None:
    # By which numpy and others decide what to write, and whether to add another.
    (tmp_path / "link.NPZ").symlink_to(tmp_path / "data.bin")
    with replacing(tmp_path / "link.NPZ") as partial:
        assert partial.suffix == ".npz"
        partial.write_text("new")
    assert (tmp_path / "data.bin").read_text() == "new"


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
