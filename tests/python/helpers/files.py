# SPDX-License-Identifier: GPL-3.0-or-later
"""One small cloud, as the content of a file of every format."""

from __future__ import annotations

import io

import numpy as np
from helpers.clouds import sphere_points
from numpy.typing import NDArray
from plyfile import PlyData, PlyElement

POINTS = 3 * sphere_points(20)
NORMALS = sphere_points(20)
FACES = "f 1 2 3\n"


def lines(rows: NDArray[np.float64], separator: str = " ", prefix: str = "") -> str:
    return "".join(prefix + separator.join(map(repr, row)) + "\n" for row in rows.tolist())


def ply(text: bool = False, byte_order: str = "<", extra: bool = False, faces: bool = False) -> bytes:
    names = ["x", "y", "z", "nx", "ny", "nz"]
    vertex = np.zeros(20, [(name, "f8") for name in names] + ([("label", "i4")] if extra else []))
    for name, column in zip(names, np.hstack([POINTS, NORMALS]).T, strict=True):
        vertex[name] = column
    elements = [PlyElement.describe(vertex, "vertex")]
    if faces:
        elements.append(PlyElement.describe(np.array([([0, 1, 2],)], [("vertex_indices", "i4", (3,))]), "face"))
    stream = io.BytesIO()
    PlyData(elements, text=text, byte_order=byte_order).write(stream)
    return stream.getvalue()


def saved(**arrays: NDArray[np.float64]) -> bytes:
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


def npy(array: NDArray[np.float64]) -> bytes:
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


BOTH = np.hstack([POINTS, NORMALS])
WITH_NORMALS = {
    "binary.ply": ply(),
    "big_endian.ply": ply(byte_order=">"),
    "text.ply": ply(text=True),
    "extra.ply": ply(extra=True),
    "mesh.ply": ply(faces=True),
    "plain.xyz": lines(BOTH).encode(),
    "windows.xyz": lines(BOTH).replace("\n", "\r\n").encode(),
    "commas.csv": ("x,y,z,nx,ny,nz\n" + lines(BOTH, ",")).encode(),
    "shuffled.csv": ('"NX";"NY";"NZ";"X";"Y";"Z"\n' + lines(np.hstack([NORMALS, POINTS]), ";")).encode(),
    "tabs.txt": ("\ufeff# a scan\n\n" + lines(BOTH, "\t") + "// the end\n").encode(),
    "decimal_commas.csv": lines(BOTH, ";").replace(".", ",").encode(),
    "decimal_commas.xyz": lines(BOTH).replace(".", ",").encode(),
    "cloudcompare.asc": ("//X Y Z Nx Ny Nz\n" + lines(BOTH)).encode(),
    "counted.pts": ("20\n" + lines(BOTH)).encode(),
    "oni.pwn": lines(BOTH).encode(),
    "colored.txt": lines(np.hstack([POINTS, 255 * abs(POINTS), NORMALS])).encode(),
    "points.obj": (lines(POINTS, prefix="v ") + lines(NORMALS, prefix="vn ") + FACES).encode(),
    "named.obj": ("# made\no thing\n" + lines(POINTS, prefix="v ") + lines(NORMALS, prefix="vn ")).encode(),
    "normals_first.obj": (lines(NORMALS, prefix="vn ") + lines(POINTS, prefix="v ")).encode(),
    "normals.off": ("NOFF\n20 0 0\n\n" + lines(BOTH)).encode(),
    "wide.npy": npy(BOTH),
    "named.npz": saved(points=POINTS, normals=NORMALS),
    "wrong_extension.obj": ply(),
    "no_extension": ply(text=True),
}
WITHOUT_NORMALS = {
    "plain.xyz": lines(POINTS).encode(),
    "plain.off": ("# comment\nOFF 20 1 0\n" + lines(POINTS) + "3 0 1 2\n").encode(),
    "colored.obj": lines(np.hstack([POINTS, abs(NORMALS)]), prefix="v ").encode(),
    "other_normals.obj": (lines(POINTS, prefix="v ") + "vn 0 0 1\n").encode(),
    "plain.npy": npy(POINTS),
    "xyz.npz": saved(xyz=POINTS),
    "intensity.xyz": lines(np.hstack([POINTS, 7 + abs(POINTS[:, :1])])).encode(),
    "colored.xyz": lines(np.hstack([POINTS, 255 * abs(POINTS)])).encode(),
}
