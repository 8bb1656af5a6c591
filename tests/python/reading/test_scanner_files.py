# SPDX-License-Identifier: GPL-3.0-or-later
"""The same cloud, ten thousand kilometres off, out of files of every kind, with what they say of it."""

from __future__ import annotations

import gzip
import io
import sys
from collections.abc import Callable
from pathlib import Path

import laspy
import numpy as np
import pytest
from helpers import scanner_files
from helpers.files import lines, saved
from helpers.scanner_files import (
    CLASSES,
    COLOR_NAMES,
    COLORS,
    FILES,
    INTENSITY,
    POINTS,
    RETURNS,
    SENSOR,
    TIMES,
    WITH_SENSOR,
)
from plyfile import PlyData, PlyElement

from hdpea.errors import UnreadableInput
from hdpea.reading import CLOUD_FORMATS, parse_points, read_points, read_scans
from hdpea.reading.cloud import PointCloud, from_arrays
from hdpea.reading.merging import merged


@pytest.mark.parametrize("name", FILES)
def test_points_and_attributes_come_back(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(FILES[name]())
    cloud = read_points(tmp_path / name)
    np.testing.assert_array_equal(cloud.points, POINTS)
    np.testing.assert_array_equal(cloud.attributes["intensity"], INTENSITY)
    for column, color in zip(COLOR_NAMES, COLORS.T, strict=True):
        np.testing.assert_array_equal(cloud.attributes[column], color)
    sensors = cloud.sensors()
    assert (sensors is not None) == (name in WITH_SENSOR)
    assert sensors is None or (sensors == SENSOR).all()
    assert Path(name.removesuffix(".gz")).suffix in CLOUD_FORMATS
    # The pixels of a PTX without a point count: each of its two scans ends with three.
    places = np.arange(60) + np.repeat([0, 3], 30) if name == "scans.ptx" else np.arange(60)
    np.testing.assert_array_equal(cloud.point_index, places)


@pytest.mark.parametrize("compressed", [False, True])
def test_las_keeps_its_dimensions_its_frame_and_what_is_not_withheld(compressed: bool) -> None:
    cloud = parse_points(scanner_files.las(compressed, withheld=7))
    np.testing.assert_array_equal(cloud.points, POINTS[7:])
    np.testing.assert_array_equal(cloud.point_index, np.arange(7, len(POINTS)))
    assert cloud.crs == scanner_files.CRS
    assert cloud.notes == ("Left out points that are withheld: 7.",)
    expected = {"classification": CLASSES, "return_number": RETURNS, "gps_time": TIMES, "roughness": INTENSITY / 4}
    for name, values in expected.items():
        np.testing.assert_array_equal(cloud.attributes[name], values[7:])
    assert cloud.attributes["red"].any()


def test_files_of_a_delivery_have_the_same_attributes_but_for_colours_that_nobody_filled_in() -> None:
    filled, empty = (parse_points(scanner_files.las(compressed=False, filled=each)) for each in (True, False))
    assert set(filled.attributes) - set(empty.attributes) == set(COLOR_NAMES)
    assert not empty.attributes["classification"].any()
    assert set(merged([filled, empty]).attributes) == set(empty.attributes)


def test_laz_and_ply_of_the_same_numbers_are_the_same_cloud(tmp_path: Path) -> None:
    laz = parse_points(scanner_files.las(compressed=True))
    table = np.zeros(len(POINTS), [(axis, "f8") for axis in "xyz"])
    for axis, column in zip("xyz", POINTS.T, strict=True):
        table[axis] = column
    PlyData([PlyElement.describe(table, "vertex")]).write(str(tmp_path / "scan.ply"))
    assert read_points(tmp_path / "scan.ply").points.tobytes() == laz.points.tobytes()


@pytest.mark.parametrize(("name", "module"), [("scan.laz", "lazrs"), ("scan.e57", "pye57"), ("text.pcd", "pypcd4")])
def test_a_missing_library_is_named_with_how_to_get_it(name: str, module: str, monkeypatch: pytest.MonkeyPatch) -> None:
    content = FILES[name]()
    monkeypatch.setitem(sys.modules, module, None)
    monkeypatch.setattr("hdpea.reading.formats.find_spec", lambda wanted: None if wanted == module else object())
    with pytest.raises(UnreadableInput, match=f"{module} must be installed") as caught:
        parse_points(content)
    assert caught.value.hint == "pip install 'hdpea[io]'"


@pytest.mark.parametrize("name", [name for name in FILES if name != "table.csv"])
def test_a_file_cut_off_says_so(name: str) -> None:
    content = FILES[name]()
    with pytest.raises(UnreadableInput) as caught:
        parse_points(content[: 2 * len(content) // 3 - 3])
    assert caught.value.hint


@pytest.mark.parametrize("name", [name for name in FILES if name != "table.csv"])
def test_what_is_left_of_half_a_file_is_told_in_one_line(name: str) -> None:
    content = FILES[name]()
    for length in (100, len(content) // 2):
        with pytest.raises(UnreadableInput) as caught:
            parse_points(content[:length])
        assert len(caught.value.message.splitlines()) == 1


@pytest.mark.parametrize("name", ["scan.las", "scan.laz"])
def test_a_record_whose_name_is_no_text_is_damage(name: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    (tmp_path / name).write_bytes(FILES[name]().replace(b"LASF_Projection", b"LASF_\x9brojection"))
    assert "damaged" in failed(3, "info", tmp_path / name)


def test_las_without_points_is_refused() -> None:
    stream = io.BytesIO()
    laspy.LasData(laspy.LasHeader(point_format=3, version="1.2")).write(stream)
    with pytest.raises(UnreadableInput, match="no points"):
        parse_points(stream.getvalue())


def test_gzip_that_would_fill_the_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.reading.compression.ALWAYS_UNPACKED", 1000)
    with pytest.raises(UnreadableInput, match="unpack to more"):
        parse_points(gzip.compress(b"0 0 0\n" * 1_000_000))
    twice = gzip.compress(b"0 0 0\n") + gzip.compress(b"1 1 1\n")
    assert len(parse_points(twice).points) == 2


def test_gaussian_splats_are_their_centres() -> None:
    names = ["x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", "f_rest_0", "opacity", "scale_0", "rot_0"]
    rows = np.zeros(4, [(name, "<f4") for name in names])
    rows["x"], rows["f_dc_0"] = np.arange(4), -9
    header = "".join(f"property float {name}\n" for name in names)
    content = f"ply\nformat binary_little_endian 1.0\nelement vertex 4\n{header}end_header\n".encode()
    cloud = parse_points(content + rows.tobytes())
    assert set(cloud.attributes) == {"opacity", "red", "green", "blue"}
    assert cloud.attributes["red"].tolist() == [0] * 4
    assert cloud.attributes["green"].tolist() == [0.5] * 4
    assert "splats" in cloud.notes[0]


def test_the_camera_of_a_ply_is_its_sensor() -> None:
    camera = "element camera 1\nproperty float view_px\nproperty float view_py\nproperty float view_pz\n"
    vertex = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
    cloud = parse_points(f"ply\nformat ascii 1.0\n{camera}{vertex}end_header\n1 2 3\n0 0 0\n4 4 4\n".encode())
    assert cloud.points.tolist() == [[0, 0, 0], [4, 4, 4]]
    assert np.array_equal(cloud.sensors(), [[1, 2, 3]] * 2)


def test_scans_become_one_cloud_with_what_all_have() -> None:
    sensors = np.ones((3, 3))
    one = PointCloud(np.zeros((3, 3)), attributes={"intensity": np.arange(3), "label": np.arange(3)})
    two = from_arrays(np.ones((3, 3)), np.ones((3, 3)), sensors)
    both = merged([one, two])
    assert both.points.shape == (6, 3)
    assert both.attributes == {}
    assert both.normals is not None
    assert both.normals[:3].any() == 0
    assert both.notes == ("Left out, since not every scan has them: intensity, label, sensor.",)
    columns = {f"sensor_{axis}": np.ones(3) for axis in "xyz"}
    same = merged([two, PointCloud(np.zeros((3, 3)), attributes=columns)])
    assert np.array_equal(same.sensors(), np.ones((6, 3)))


def test_scans_of_several_frames_are_refused() -> None:
    clouds = [PointCloud(np.zeros((3, 3)), crs=crs) for crs in ("EPSG:25832", "EPSG:25833")]
    with pytest.raises(UnreadableInput, match="EPSG:25832 and EPSG:25833"):
        merged(clouds)
    assert merged([clouds[0], PointCloud(np.zeros((3, 3)))]).crs == "EPSG:25832"


def test_a_scan_without_points_is_named_among_others(tmp_path: Path) -> None:
    (tmp_path / "good.xyz").write_text(lines(POINTS))
    (tmp_path / "bad.npz").write_bytes(saved(points=np.full((9, 3), np.nan)))
    with pytest.raises(UnreadableInput, match=r"bad.npz: none of its 9 points is finite"):
        read_scans([tmp_path / "good.xyz", tmp_path / "bad.npz"])
