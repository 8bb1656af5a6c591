# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ and OFF: mesh formats that are often used for points; only their vertices are read."""

from __future__ import annotations

import re

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import MESH_NOTE, PointCloud, from_columns
from hdpea.reading.tables import columns_by_name, name_columns, parse_table

_COLORS = ["red", "green", "blue"]


def parse_obj(data: bytes) -> PointCloud:
    """Read the ``v`` lines of an OBJ file, and the ``vn`` lines if there is one for each ``v``.

    Six numbers after a ``v`` are coordinates and a colour.

    Raises
    ------
    UnreadableInput
        If there is no ``v`` line, or one does not hold numbers.
    """
    text = data.decode("utf-8", errors="replace")
    vertices = parse_table(_after_keyword(text, "v"))
    normals = parse_table(_after_keyword(text, "vn"))
    names = ["x", "y", "z", *(_COLORS if vertices.shape[1] == 6 else ["w"])]
    columns = columns_by_name(names[: vertices.shape[1]], vertices)
    if normals.shape == (len(vertices), 3):
        columns |= columns_by_name(["nx", "ny", "nz"], normals)
    notes = [MESH_NOTE] if re.search(r"^\s*f\s", text, re.MULTILINE) else []
    return from_columns(columns, "OBJ", notes)


def _after_keyword(text: str, keyword: str) -> list[str]:
    return re.findall(rf"^[ \t]*{keyword}[ \t]+([^\n#]*)", text, re.MULTILINE)


def parse_off(data: bytes) -> PointCloud:
    """Read the vertices of a text OFF file: OFF, NOFF (with normals) or COFF (with colours).

    Raises
    ------
    UnreadableInput
        If the counts are missing or the file ends before the last vertex.
    """
    text = re.sub(r"#[^\n]*", "", data.decode("utf-8", errors="replace"))
    header = re.match(r"\s*(?:ST)?(C?)(N?)OFF\s+(\d+)\s+(\d+)(?:[ \t]+\d+)?", text)
    if header is None:
        raise UnreadableInput("it has no counts of vertices and faces after OFF.", "Binary OFF is not read.")
    has_normals, count, faces = bool(header[2]), int(header[3]), int(header[4])
    if count == 0:
        raise UnreadableInput("there are no points in it.")
    lines = [line for line in text[header.end() :].splitlines() if line.strip()]
    table = parse_table(lines[:count])
    if len(table) < count:
        raise UnreadableInput(f"it ends after {len(table)} of its {count} points.")
    return from_columns(name_columns(table, has_normals), "OFF", [MESH_NOTE] if faces else [])
