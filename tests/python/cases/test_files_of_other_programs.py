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


def numbered(rows: list[str], first: int = 0, step: int = 1) -> list[str]:
    return [f"{first + i * step},{row}" for i, row in enumerate(rows)]


def picked(rows: list[str]) -> list[str]:
    """Some rows of a longer table, not in its order, each after its number."""
    return [f"{(7 * i) % 97} {row}" for i, row in enumerate(rows, 1)]


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
    "pandas_array": joined(numbered(COMMAS, 5, 3), ",0,1,2\n"),
    "pandas_array_shuffled": joined([row.replace(" ", ",") for row in picked(SPACED)], ",0,1,2\n"),
    "pandas_array_without_index": joined(COMMAS, "0,1,2\n"),
    "pandas_array_in_tabs": joined([row.replace(",", "\t") for row in numbered(COMMAS)], "\t0\t1\t2\n"),
    "pandas_picked": joined(picked(SPACED), " x y z\n"),
    "r_picked": joined([f'"{row}'.replace(" ", '" ', 1) for row in picked(SPACED)], '"x" "y" "z"\n'),
    "r_picked_with_id": joined([row.replace(" ", f" {i} ", 1) for i, row in enumerate(picked(SPACED))], "id x y z\n"),
    "survey": joined(numbered(COMMAS, 1)),
    "survey_later": joined(numbered(COMMAS, 1001)),
    "survey_gaps": joined(numbered(COMMAS[:20], 1) + numbered(COMMAS[20:], 31)),
    "survey_in_tens": joined(numbered(COMMAS, 10, 10)),
    "survey_falling": joined(numbered(COMMAS, 40, -1)),
    "survey_falling_with_normals": joined([f"{row},0,0,1" for row in numbered(COMMAS, 40, -1)]),
    "empty_column": joined([f"{i},,{row}" for i, row in enumerate(COMMAS)], "id,code,x,y,z\n"),
    "empty_field": joined([f"{row}{',5,2' if i % 7 else ',,2'}" for i, row in enumerate(COMMAS)], "x,y,z,i,class\n"),
    "word_column": joined([f"{row},ground" for row in COMMAS], "x,y,z,class\n"),
    "names_first": joined([f"P{i},{row}" for i, row in enumerate(COMMAS)], "name,x,y,z\n"),
    "pnezd": joined([f"{row},GND" for row in numbered(COMMAS, 1)]),
    "words_with_separators": joined([f'"a, b",{row}' for row in COMMAS], "name,x,y,z\n"),
    "quoted": joined([",".join(f'"{each}"' for each in row.split()) for row in SPACED], '"X","Y","Z"\n'),
    "quoted_decimal_commas": joined(
        [",".join(f'"{each}"'.replace(".", ",") for each in row.split()) for row in SPACED], '"x","y","z"\n'
    ),
    "quoted_commas_in_names": joined(COMMAS, '"x [m, UTM]","y [m, UTM]","z [m, NN]"\n'),
    "german": joined([row.replace(" ", ";").replace(".", ",") for row in SPACED], "x;y;z\n"),
    "easting": joined(COMMAS, "Easting [m],Northing [m],Elevation [m]\n"),
    "units": joined(numbered(COMMAS), "t,x,y,z\n,m,m,m\n"),
    "fewer_units": joined([f"{i / 8} {row}" for i, row in enumerate(SPACED)], "t x y z\nm m m\n"),
    "dashes": joined([f"{i / 8} {row}" for i, row in enumerate(SPACED)], "t x y z\n--- --- --- ---\n"),
    "one_line_of_dashes": joined([f"{i / 8} {row}" for i, row in enumerate(SPACED)], "t x y z\n-------\n"),
    "arcgis": joined([f"{row},7" for row in COMMAS], "POINT_X,POINT_Y,POINT_Z,FID\n"),
    "paraview": joined([f"0,{row}" for row in COMMAS], '"t","Points:0","Points:1","Points:2"\n'),
    "gauss_krueger": joined([f"7;{row.replace(' ', ';')}" for row in SPACED], "Nr;Rechtswert;Hochwert;Höhe\n"),
    "of_windows": joined(COMMAS, "Rechtswert,Hochwert,Höhe\n").decode().encode("cp1252"),
    "csv_of_a_mac": joined(numbered(COMMAS), "id,x,y,z\n").replace(b"\n", b"\r"),
    "pcd_0.5": joined(SPACED, "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 40\nDATA ascii\n"),
    "order_of_the_header": joined([",".join(row.split()[::-1]) for row in SPACED], "height,north,east\n"),
    "nan_of_windows": joined([*SPACED, "-nan(ind) -nan(ind) -nan(ind)", "1.#QNAN 0 0"]),
    "infinity_of_windows": joined([*SPACED, "1.#INF00 0 0", "-1.#J 0 0"]),
    "nan_of_windows_ply": joined(
        ["-nan(ind) -nan(ind) nan", *SPACED, "1.#IND 0 0"],
        PLY.format("ascii", "", "vertex", FLOATS).replace("40", "42"),
    ),
    "nan_of_windows_ply_with_lists": joined(
        [f"{row} 0" for row in [*SPACED, "nan(ind) 0 0"]],
        PLY.format("ascii", "", "vertex", FLOATS + "property list uchar int seen\n").replace("40", "41"),
    ),
    "nan_of_windows_obj": OBJ + b"v -nan(ind) -nan(ind) -nan(ind)\n",
    "utf16": joined(SPACED).decode().replace("\n", "\r\n").encode("utf-16"),
    "two_scans_of_pts": joined(SPACED[:20], "20\n") + joined(SPACED[20:], "20\r\n"),
    "longer_header": joined(COMMAS, "x,y,z,intensity\n"),
    "ptx": joined([f"{row} 0.5" for row in SPACED], PTX),
    "blank_lines_ply": joined([row + "\n" for row in SPACED], PLY.format("ascii", "", "vertex", FLOATS)),
    "utf8_ply": PLY.format("binary_little_endian", "comment Straße\n", "vertex", FLOATS).encode() + BINARY,
    "latin1_ply": PLY.format("binary_little_endian", "obj_info Straße\n", "vertex", FLOATS).encode("latin1") + BINARY,
    "blanks_in_ply": PLY.format("binary_little_endian", "", "vertex", FLOATS).replace("\n", " \n").encode() + BINARY,
    "header_of_a_mac": PLY.format("binary_little_endian", "", "vertex", FLOATS).replace("\n", "\r").encode() + BINARY,
    "marked_ply": b"\xef\xbb\xbf" + PLY.format("binary_little_endian", "", "vertex", FLOATS).encode() + BINARY,
    "points_ply": PLY.format("binary_little_endian", "", "points", FLOATS).encode() + BINARY,
    "twice_the_same_name": joined(
        [f"{row} 1 2" for row in SPACED],
        PLY.format("ascii", "", "vertex", FLOATS + 2 * "property float größe\n"),
    ),
    "3dsmax_obj": b"# 3ds Max\n\nmtllib foo.mtl\n\n#\n# object Sphere001\n#\n\n" + OBJ,
    "zbrush_obj": b"# ZBrush\nmtllib b.mtl\n\n#Object: obj0\n#Vertex Count: 40\n" + OBJ,
    "marked_obj": b"\xef\xbb\xbf# made\n" + OBJ,
    "obj_of_a_mac": OBJ.replace(b"\n", b"\r"),
    "continued_obj": b"# C:\\scans\\\n" + OBJ.replace(b" 0.", b" \\\n 0."),
    "vp_first_obj": b"vp 0 0 0\nvp 1 0 0\n" + OBJ,
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
        ("survey_gaps", "Column 1 numbers the rows; the next three are taken for x, y and z."),
        ("pandas_array", "Column 1 numbers the rows; the next three are taken for x, y and z."),
        ("word_column", "Left out, since they hold no numbers: columns 4."),
        ("empty_field", "Empty fields, taken for unknown: 6."),
        ("longer_header", "Its header names 4 columns, its rows have 3: the first three are taken for coordinates."),
    ],
)
def test_what_is_guessed_is_told(name: str, note: str) -> None:
    assert note in parse_points(READ[name]).notes


@pytest.mark.parametrize("header", ["", "x y z\n"])
@pytest.mark.parametrize(
    "rows",
    [
        [f"{i // 6} {i % 6} {i % 7 + 0.25} 0.5" for i in range(36)],  # a grid
        [f"{3 * i} {i / 8} {i % 7 + 0.25}" for i in range(36)],  # a profile
        [f"{3 * i} {i / 8} {i % 7 + 0.25} 7" for i in range(36)],
        [f"{3 * i} {i / 8} {i % 7 + 0.25} 0.6 0 0.8" for i in range(36)],  # with normals
        ["0 1 2", "0.5 1 2"],
        ["0 1 2"],
    ],
)
def test_a_first_column_of_whole_numbers_may_be_x(rows: list[str], header: str) -> None:
    table = np.array([row.split()[:3] for row in rows], np.float64)
    np.testing.assert_array_equal(parse_points(joined(rows, header)).points, table)


@pytest.mark.parametrize(
    ("row", "point"),
    [
        ('"500,1","540,3","21,0"', [500.1, 540.3, 21]),
        ('"500,123.5","5,540,321.25","-1,210.0"', [500123.5, 5540321.25, -1210]),
        ('"500.123,5","5.540.321,25","-1.210,0"', [500123.5, 5540321.25, -1210]),
        ('"500,123","5,540,321","210"', [500123, 5540321, 210]),
        ('"500,123";"540,321";"0,5"', [500.123, 540.321, 0.5]),
        ('0.25,"500,123",1.5', [0.25, 500123, 1.5]),
        ('"1,5e3","0,25","oak, old",2', [1500, 0.25, 2]),
    ],
)
def test_commas_in_quotes_are_decimal_signs_or_part_thousands(row: str, point: list[float]) -> None:
    assert parse_points(joined([row, row])).points.tolist() == [point, point]


@pytest.mark.parametrize("first", ["p 1", "newmtl none\nKd 1 0 0", "cstype bezier\nbmat u 1 0", "lod 1", "f 1 2 3"])
def test_an_obj_that_is_called_one_may_begin_with_any_statement(first: str) -> None:
    cloud = parse_points(first.encode() + b"\n" + OBJ, ".obj")
    assert cloud.format == "OBJ"
    np.testing.assert_array_equal(cloud.points, POINTS)


def test_a_first_byte_that_looks_like_a_line_feed_is_of_the_first_point() -> None:
    points = np.array([[np.frombuffer(b"\n\0\0\0\0\0\xf0?")[0], 2, 3]] * 40)
    header = PLY.format("binary_little_endian", "", "vertex", FLOATS).replace("\n", "\r").encode()
    np.testing.assert_array_equal(parse_points(header + points.tobytes()).points, points)


def test_a_table_that_is_called_obj_is_a_table() -> None:
    np.testing.assert_array_equal(parse_points(joined(SPACED), ".obj").points, POINTS)


def test_normals_that_are_not_there_are_unknown() -> None:
    normals = joined([f"vn {row}" for row in SPACED[:-1]]) + b"vn -nan(ind) 1.#QNAN nan\n"
    found = parse_points(OBJ + normals).normals
    assert found is not None
    np.testing.assert_array_equal(found, [*POINTS[:-1], [np.nan] * 3])
    paraview = joined([f"{row},{row}" for row in COMMAS], "Points:0,Points:1,Points:2,Normals:0,Normals:1,Normals:2\n")
    np.testing.assert_array_equal(parse_points(paraview).normals, POINTS)


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
        (joined([f"{3 * i} {row} 0.5" for i, row in enumerate(SPACED)], "id x y z\n"), "its header names 4 columns"),
        (joined(['"500,123","540,321","10,250"'] * 2), "may be decimal signs or part thousands"),
        (joined(['"500,123.5","540.321,5","1"'] * 2), "may be decimal signs or part thousands"),
        (joined(['1,2,3,"a"', '1,2,3,"' + "a" * 200_000]), "it is no table (field larger than field limit"),
        (joined([*COMMAS, "1,2"], "x,y,z\n"), "line 42 reads '1,2'"),
        (joined([*(f"{row},a" for row in COMMAS), "1,2,three,b"], "x,y,z,name\n"), "line 42 reads '1,2,three,b'"),
    ],
)
def test_tables_that_do_not_fit_are_refused(content: bytes, reason: str) -> None:
    with pytest.raises(UnreadableInput) as caught:
        parse_points(content)
    assert reason in caught.value.message
