# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ and OFF: mesh formats that are often used for points; only their vertices are read."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.geometry.color import RGB
from hdpea.reading.cloud import MESH_NOTE, PointCloud, from_columns
from hdpea.reading.tables import columns_by_name, look_like_normals, name_columns, parse_table, without_words_for_nan

_AXES, _NORMALS = ["x", "y", "z"], ["nx", "ny", "nz"]
_CORNER = re.compile(r"(?<=\s)(\d+)/\d*/(\d+)")
_OTHER_NORMAL = re.compile(r"(?<=\s)(\d+)/\d*/(?!\1(?!\d))\d")
"""A corner whose normal has another number than its vertex."""
_CONTINUED = re.compile(r"^[ \t]*(?:vn?|f)[ \t](?:[^\n#\\]*\\[ \t]*\n)+", re.MULTILINE)
"""Lines that end in a backslash, as those of a comment may, too."""


def parse_obj(data: bytes) -> PointCloud:
    """Read the ``v`` lines of an OBJ file, and the ``vn`` lines as its faces say, else if there is one for each ``v``.

    Six or seven numbers after a ``v`` are coordinates and a colour, which some vertices may lack.

    Raises
    ------
    UnreadableInput
        If there is no ``v`` line, or one does not hold numbers.
    """
    text = re.sub(r"\r\n?", "\n", data.decode("utf-8-sig", errors="replace"))
    text = without_words_for_nan(text)  # before what follows a # is taken for a comment
    if "\\" in text:
        text = _CONTINUED.sub(lambda found: re.sub(r"\\\s*\n", " ", found[0]), text)
    vertices = _vertices(_after_keyword(text, "v"))
    normals = parse_table(_after_keyword(text, "vn"))
    others = {6: [*RGB], 7: [*RGB, "alpha"], 4: ["w"]}
    names = [*_AXES, *others.get(vertices.shape[1], [])][: vertices.shape[1]]
    columns = columns_by_name(names, vertices[:, : len(names)])
    of_vertices = _normals_of_vertices(text, normals, len(vertices))
    if of_vertices is not None:
        columns |= columns_by_name(_NORMALS, of_vertices)
    notes = [MESH_NOTE] if re.search(r"^\s*f\s", text, re.MULTILINE) else []
    return from_columns(columns, "OBJ", notes)


def _vertices(lines: Sequence[str]) -> NDArray[np.float64]:
    """Return the numbers after ``v``, NaN where some vertices have fewer than others."""
    widths = {len(line.split()) for line in lines}
    if len(widths) > 1 and min(widths) >= 3:
        most = max(widths)
        lines = [line + " nan" * (most - len(line.split())) for line in lines]
    return parse_table(lines)


def _normals_of_vertices(text: str, normals: NDArray[np.float64], count: int) -> NDArray[np.float64] | None:
    """Return the normals (count, 3) of the vertices, the mean of those that faces give them; None if unknown."""
    if not len(normals) or normals.shape[1] != 3:
        return None
    faces = "\n".join(_after_keyword(text, "f", " "))
    if len(normals) == count and not _OTHER_NORMAL.search(faces):
        # Also without faces, or with corners that are counted from the end.
        return normals
    corners = np.array(_CORNER.findall(faces), np.int64).reshape(-1, 2) - 1
    if not len(corners):
        return None
    if corners.min() < 0 or corners[:, 0].max() >= count or corners[:, 1].max() >= len(normals):
        raise UnreadableInput("a face has a corner that is not there.", "It may have been cut off while being copied.")
    corners = np.unique(corners, axis=0)
    sums = np.zeros((count, 3))
    np.add.at(sums, corners[:, 0], normals[corners[:, 1]])
    return sums


def _after_keyword(text: str, keyword: str, before: str = "") -> list[str]:
    return [before + line for line in re.findall(rf"^[ \t]*{keyword}[ \t]+([^\n#]*)", text, re.MULTILINE)]


def parse_off(data: bytes) -> PointCloud:
    """Read the vertices of a text OFF file, be they with normals, colours (in either order) or neither.

    Raises
    ------
    UnreadableInput
        If the counts are missing or the file ends before the last vertex.
    """
    text = re.sub(r"#[^\n]*", "", data.decode("utf-8", errors="replace"))
    header = re.match(r"\s*([A-Z]*)OFF\s+(\d+)\s+(\d+)(?:[ \t]+\d+)?", text)
    if header is None:
        raise UnreadableInput("it has no counts of vertices and faces after OFF.", "Binary OFF is not read.")
    kind, count, faces = header[1], int(header[2]), int(header[3])
    if count == 0:
        raise UnreadableInput("there are no points in it.")
    lines = [line for line in text[header.end() :].splitlines() if line.strip()]
    table = parse_table(lines[:count])
    if len(table) < count:
        raise UnreadableInput(f"it ends after {len(table)} of its {count} points.")
    return from_columns(_off_columns(kind, table), "OFF", [MESH_NOTE] if faces else [])


def _off_columns(kind: str, table: NDArray[np.float64]) -> dict[str, NDArray[Any]]:
    """Name the columns (n, c) after those letters: N normals, C colours, ST coordinates of a texture."""
    width = table.shape[1] - 2 * ("ST" in kind)
    table = table[:, :width]
    colors = [*RGB, "alpha"][: width - 3 - 3 * ("N" in kind)]
    if width not in {6, 7, 9, 10} or ("N" not in kind and look_like_normals(table[:, 3:6])):
        return name_columns(table, normals_expected="N" in kind)
    if "N" not in kind:
        return columns_by_name([*_AXES, *colors], table)
    # Geomview's definition has normals first, MeshLab writes them last.
    last = width > 6 and not look_like_normals(table[:, 3:6])
    return columns_by_name([*_AXES, *colors, *_NORMALS] if last else [*_AXES, *_NORMALS, *colors], table)
