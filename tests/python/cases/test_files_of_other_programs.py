# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of other programs are read for what they are, or refused with the command that converts them."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import pytest
from helpers.clouds import sphere_points

from hdpea.errors import UnreadableInput
from hdpea.reading import parse_points

POINTS = np.round(sphere_points(40) * [1, 0.8, 0.6], 6)
SPACED = [" ".join(f"{number:.6f}" for number in row) for row in POINTS.tolist()]
COMMAS = [row.replace(" ", ",") for row in SPACED]


def joined(rows: list[str], before: str = "") -> bytes:
    return (before + "".join(row + "\n" for row in rows)).encode()


def npz(**arrays: Any) -> bytes:
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def numbered(rows: list[str], first: int = 0) -> list[str]:
    return [f"{i},{row}" for i, row in enumerate(rows, first)]


PLY = "ply\nformat {} 1.0\n{}element {} 40\n{}end_header\n"
FLOATS = "property double x\nproperty double y\nproperty double z\n"
BINARY = np.ascontiguousarray(POINTS, "<f8").tobytes()
OBJ = joined([f"v  {row}" for row in SPACED])
PTX = "8\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
RECORDS = np.ascontiguousarray(POINTS).view([("x", "f8"), ("y", "f8"), ("z", "f8")])[:, 0]

READ = {
    "pandas": joined(numbered(COMMAS), ",x,y,z\n"),
    "r": joined([f'"{i}",{row}' for i, row in enumerate(COMMAS, 1)], '"","x","y","z"\n'),
    "r_table": joined([f'"{i}" {row}' for i, row in enumerate(SPACED, 1)], '"x" "y" "z"\n'),
    "survey": joined(numbered(COMMAS, 1)),
    "survey_later": joined(numbered(COMMAS, 1001)),
    "empty_column": joined([f"{i},,{row}" for i, row in enumerate(COMMAS)], "id,code,x,y,z\n"),
    "empty_field": joined([f"{row}{',5,2' if i % 7 else ',,2'}" for i, row in enumerate(COMMAS)], "x,y,z,i,class\n"),
    "word_column": joined([f"{row},ground" for row in COMMAS], "x,y,z,class\n"),
    "names_first": joined([f"P{i},{row}" for i, row in enumerate(COMMAS)], "name,x,y,z\n"),
    "pnezd": joined([f"{row},GND" for row in numbered(COMMAS, 1)]),
    "words_with_separators": joined([f'"a, b",{row}' for row in COMMAS], "name,x,y,z\n"),
    "quoted": joined([",".join(f'"{each}"' for each in row.split()) for row in SPACED], '"X","Y","Z"\n'),
    "german": joined([row.replace(" ", ";").replace(".", ",") for row in SPACED], "x;y;z\n"),
    "easting": joined(COMMAS, "Easting [m],Northing [m],Elevation [m]\n"),
    "order_of_the_header": joined([",".join(row.split()[::-1]) for row in SPACED], "height,north,east\n"),
    "nan_of_windows": joined([*SPACED, "-nan(ind) -nan(ind) -nan(ind)", "1.#QNAN 0 0"]),
    "utf16": joined(SPACED).decode().replace("\n", "\r\n").encode("utf-16"),
    "two_scans_of_pts": joined(SPACED[:20], "20\n") + joined(SPACED[20:], "20\r\n"),
    "longer_header": joined(COMMAS, "x,y,z,intensity\n"),
    "ptx": joined([f"{row} 0.5" for row in SPACED], PTX),
    "blank_lines_ply": joined([row + "\n" for row in SPACED], PLY.format("ascii", "", "vertex", FLOATS)),
    "utf8_ply": PLY.format("binary_little_endian", "comment Straße\n", "vertex", FLOATS).encode() + BINARY,
    "latin1_ply": PLY.format("binary_little_endian", "obj_info Straße\n", "vertex", FLOATS).encode("latin1") + BINARY,
    "points_ply": PLY.format("binary_little_endian", "", "points", FLOATS).encode() + BINARY,
    "twice_the_same_name": joined(
        [f"{row} 1 2" for row in SPACED],
        PLY.format("ascii", "", "vertex", FLOATS + 2 * "property float größe\n"),
    ),
    "3dsmax_obj": b"# 3ds Max\n\nmtllib foo.mtl\n\n#\n# object Sphere001\n#\n\n" + OBJ,
    "zbrush_obj": b"# ZBrush\nmtllib b.mtl\n\n#Object: obj0\n#Vertex Count: 40\n" + OBJ,
    "grouped_obj": b"o 1\n\n# Vertex list\n\n" + OBJ,
    "negative_obj": OBJ + b"vt 0 0\nf -3/-1 -2/-1 -1/-1\n",
    "rgba_obj": joined([f"v {row} 1.0 0.2 0.3 1.0" for row in SPACED]),
    "partly_coloured_obj": joined([f"v {row}{'' if i % 2 else ' 1 0.2 0.3'}" for i, row in enumerate(SPACED)]),
    "meshlab_off": joined([f"{row} 255 255 255 255 {row}" for row in SPACED], "NCOFF\n40 0 0\n"),
    "coloured_off": joined([f"{row} 10 20 30 255" for row in SPACED], "COFF\n40 0 0\n"),
    "pickled_npz": npz(points=POINTS, meta=np.array({"a": 1}, dtype=object)),
    "coord_npz": npz(coord=POINTS, normal=POINTS),
    "structured_npz": npz(points=RECORDS),
}  # fmt: skip


@pytest.mark.parametrize("name", READ)
def test_files_are_read_for_what_they_are(name: str) -> None:
    cloud = parse_points(READ[name])
    finite = cloud.points[np.isfinite(cloud.points).all(axis=1)]
    np.testing.assert_array_equal(finite, POINTS)


@pytest.mark.parametrize(
    ("name", "note"),
    [
        ("survey", "Column 1 numbers the rows; the next three are taken for x, y and z."),
        ("word_column", "Left out, since they hold no numbers: columns 4."),
        ("empty_field", "Empty fields, taken for unknown: 6."),
        ("longer_header", "Its header names 4 columns, its rows have 3: the first three are taken for coordinates."),
    ],
)
def test_what_is_guessed_is_told(name: str, note: str) -> None:
    assert note in parse_points(READ[name]).notes


def test_colours_and_normals_of_meshes_are_kept() -> None:
    cloud = parse_points(READ["meshlab_off"])
    np.testing.assert_array_equal(cloud.normals, POINTS)  # not of length 1, but no colours either
    assert cloud.attributes["alpha"].tolist() == [255] * 40
    assert parse_points(READ["rgba_obj"]).attributes["green"].tolist() == [0.2] * 40
    assert np.isnan(parse_points(READ["partly_coloured_obj"]).attributes["red"]).sum() == 20


def test_normals_of_an_obj_are_those_that_its_faces_give() -> None:
    content = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 0\nvn 0 1 0\nf 1//3 2//1 3//2\n"
    assert np.array_equal(parse_points(content).normals, [[0, 1, 0], [0, 0, 1], [1, 0, 0]])


@pytest.mark.parametrize(
    ("content", "what", "command"),
    [
        (b"ncols 60\nnrows 50\nxllcorner 5\nyllcorner 4\ncellsize 1\n1 2 3\n4 5 6\n", "ESRI grid", "gdal_translate"),
        (b"solid cube\nfacet normal 0 0 1\n", "STL", "assimp"),
        (b"glTF\2\0\0\0", "glTF", "assimp"),
        (b"PK\3\4" + bytes(26) + b"[Content_Types].xml", "spreadsheet", "soffice"),
        (b"II*\0" + bytes(9), "TIFF", "gdal_translate"),
        (b"<html><body>404</body></html>", "HTML", "pdal"),
        (joined(COMMAS, "lon,lat,height\n"), "degrees", "gdaltransform"),
    ],
)
def test_what_is_no_table_of_points_is_refused_with_the_command_that_converts_it(
    content: bytes, what: str, command: str
) -> None:
    with pytest.raises(UnreadableInput, match=what) as caught:
        parse_points(content)
    assert command in caught.value.hint


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (joined([f"7,{row},8" for row in COMMAS], "id,x,y,z\n"), "its header names 4 columns, its rows have 5"),
        (joined([*COMMAS, "1,2"], "x,y,z\n"), "line 42 reads '1,2'"),
        (joined([*(f"{row},a" for row in COMMAS), "1,2,three,b"], "x,y,z,name\n"), "line 42 reads '1,2,three,b'"),
    ],
)
def test_tables_that_do_not_fit_are_refused(content: bytes, reason: str) -> None:
    with pytest.raises(UnreadableInput) as caught:
        parse_points(content)
    assert reason in caught.value.message
