# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that cannot be read: each says why, and what to do."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest
from helpers.clouds import sphere_points
from helpers.files import WITH_NORMALS, npy, ply, saved
from hypothesis import given
from hypothesis import strategies as st

from hdpea.errors import UnreadableInput
from hdpea.reading import parse_points, read_points

BAD_CONTENT = {
    "empty.ply": (b"", "empty"),
    "blank.xyz": (b" \n\n", "empty"),
    "only_comments.xyz": (b"# x y z\n", "no points"),
    "none.ply": (b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "no points"),
    "only_faces.ply": (b"ply\nformat ascii 1.0\nelement face 0\nend_header\n", "no points"),
    "cut_binary.ply": (ply()[:-100], "ends after 17 of its 20 points"),
    "cut_text.ply": (ply(text=True)[:-400], "line|ends after"),
    "cut_header.ply": (ply()[:60], "damaged"),
    "no_z.ply": (ply().replace(b"double z\n", b"double Q\n"), "no columns x, y and z"),
    "words.xyz": (b"1 2 3\n4 five 6\n", "line 2 reads '4 five 6', where 'five' is no number"),
    "decimal.csv": (b"0,1;2,5;3\n4,5;five,5;6\n", "line 2 reads '4,5;five,5;6', where field 2, 'five.5', is no number"),
    "long.xyz": (b"1 2 3\n" + b"1.25 " * 40 + b"\n", "1.25 ...', where 3 numbers are expected"),
    "commas.csv": (b"-0,0721,-0,1597,0,25\n0,0021,0,1597,-0,25\n", "commas are its decimal signs, and between"),
    "ragged.xyz": (b"# scan\n1 2 3\n\n4 5\n", "line 4 reads '4 5', where 3 numbers"),
    "flat.xyz": (b"1 2\n3 4\n", "2 numbers per line"),
    "unnamed.csv": (b"id,east,north\n1,2,3\n", "no columns x, y and z"),
    "digits.xyz": (b"9" * 5000 + b"\n1 2 3\n", "a number of 5,000 digits"),
    "digits.pts": (b"1\n1 2 3\n" + b"9" * 19 + b"\n1 2 3\n", "a number of 19 digits"),
    "digits.ptx": (b"9" * 5000 + b"\n1\n" + b"0 0 0\n" * 4 + b"1 0 0 0\n" * 4, "a number of 5,000 digits"),
    "no_vertices.off": (b"OFF\n0 0 0\n", "no points"),
    "cut.off": (b"OFF\n3 0 0\n0 0 0\n1 0 0\n", "ends after 2 of its 3"),
    "counts.off": (b"OFF\nmany\n", "no counts"),
    "short.obj": (b"v 1 2\n", "2 numbers|x, y and z"),
    "cut.npy": (WITH_NORMALS["wide.npy"][:-8], "too short"),
    "cut.npz": (WITH_NORMALS["named.npz"][:-30], "damaged"),
    "names.npz": (saved(cloud=sphere_points(4)), "no array named points"),
    "shape.npz": (saved(points=sphere_points(1000).T), "not numbers of shape"),
    "scan.las": (b"LASF" + bytes(100), "LAS"),
    "far.npy": (npy(1e200 * sphere_points(9)), "coordinates reach .*e\\+199"),
    "photo.png": (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "format is unknown"),
}


@pytest.mark.parametrize("name", BAD_CONTENT)
def test_bad_content_is_told_with_the_file_name(name: str, tmp_path: Path) -> None:
    content, reason = BAD_CONTENT[name]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(UnreadableInput, match=reason) as caught:
        read_points(tmp_path / name)
    assert name in caught.value.message


def test_missing_file_names_its_neighbour(tmp_path: Path) -> None:
    (tmp_path / "scan.ply").touch()
    with pytest.raises(UnreadableInput, match="no file") as caught:
        read_points(tmp_path / "scna.ply")
    assert "scan.ply" in caught.value.hint


def test_a_link_that_leads_nowhere_is_not_offered_in_its_own_place(tmp_path: Path) -> None:
    (tmp_path / "scan.ply").symlink_to("gone.ply")
    with pytest.raises(UnreadableInput, match="no file") as caught:
        read_points(tmp_path / "scan.ply")
    assert "Did you mean" not in caught.value.hint


def test_missing_folder() -> None:
    with pytest.raises(UnreadableInput, match="no file"):
        read_points("nowhere/scan.ply")


def test_folder(tmp_path: Path) -> None:
    with pytest.raises(UnreadableInput, match="folder"):
        read_points(tmp_path)


def test_file_without_permission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: Path) -> bytes:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)  # chmod does not stop root
    with pytest.raises(UnreadableInput, match="Permission denied"):
        read_points(tmp_path / "scan.ply")


def test_normals_of_other_points_are_left_out_and_told() -> None:
    cloud = parse_points(saved(points=sphere_points(30), normals=sphere_points(5)))
    assert cloud.normals is None
    assert "Left out normals" in cloud.notes[0]


@given(st.sampled_from(sorted(WITH_NORMALS)), st.data())
def test_damage_of_any_kind_is_unreadable_or_harmless(name: str, data: st.DataObject) -> None:
    content = bytearray(WITH_NORMALS[name])
    for position in data.draw(st.lists(st.integers(0, len(content) - 1), max_size=4)):
        content[position] = data.draw(st.integers(0, 255))
    del content[data.draw(st.integers(1, len(content))) :]
    with suppress(UnreadableInput):
        parse_points(bytes(content))
