# SPDX-License-Identifier: GPL-3.0-or-later
"""Co3Ne and anisotropic remeshing by Geogram, whose Python package does not expose these functions.

A small library (``geogram.cpp``) is compiled once against the installed package, and kept in the user's cache.
"""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
from hashlib import sha256
from importlib.metadata import distribution
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.benchmark.methods import Cloud
from hdpea.errors import UsageError
from hdpea.geometry.triangles import TriangleMesh
from hdpea.runtime.outputs import replacing

SOURCE = Path(__file__).with_suffix(".cpp")
ANISOTROPY = 0.04
"""Weight of the normals relative to the points, as in the example of Geogram's documentation."""


def co3ne(cloud: Cloud, radius: float) -> TriangleMesh:
    """Return the triangles by which Co3Ne (Boltcheva and Levy, 2017) connects points within a radius."""
    points, normals = (np.ascontiguousarray(each) for each in (cloud.points, cloud.normals))
    _LIBRARY.hdpea_co3ne(_doubles(points), _doubles(normals), ctypes.c_int64(len(points)), ctypes.c_double(radius))
    return _last_mesh()


def remeshed(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    """Return the anisotropic centroidal Voronoi remesh of a surface (Levy and Bonneel, 2012)."""
    points, faces = np.ascontiguousarray(mesh[0]), np.ascontiguousarray(mesh[1])
    _LIBRARY.hdpea_remesh(
        _doubles(points),
        ctypes.c_int64(len(points)),
        _integers(faces),
        ctypes.c_int64(len(faces)),
        ctypes.c_int64(vertices),
        ctypes.c_double(ANISOTROPY),
    )
    return _last_mesh()


def _last_mesh() -> TriangleMesh:
    points = np.empty((_LIBRARY.hdpea_vertex_count(), 3), np.float64)
    faces = np.empty((_LIBRARY.hdpea_face_count(), 3), np.int64)
    _LIBRARY.hdpea_copy(_doubles(points), _integers(faces))
    return points, faces


def _doubles(array: NDArray[np.float64]) -> ctypes.Array[ctypes.c_double]:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))  # type: ignore[return-value]


def _integers(array: NDArray[np.int64]) -> ctypes.Array[ctypes.c_int64]:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_int64))  # type: ignore[return-value]


def _compiled() -> Path:
    """Return the path of the compiled library, which is built if it is not in the cache.

    Raises
    ------
    UsageError
        If there is no C++ compiler, or it fails.
    """
    package = distribution("geogram")
    key = sha256(SOURCE.read_bytes() + package.version.encode()).hexdigest()[:16]
    cache_folder = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "hdpea"
    built = cache_folder / f"geogram-{key}.so"
    if built.exists():
        return built
    compiler = shutil.which("c++") or shutil.which("g++")
    if compiler is None:
        raise UsageError("Geogram needs a C++ compiler.", "On Debian and Ubuntu: apt-get install g++")
    cache_folder.mkdir(parents=True, exist_ok=True)
    files = {Path(str(each)).name: Path(str(package.locate_file(each))) for each in package.files or ()}
    static = files["libgeogram.a"]
    includes = next(parent for parent in files["co3ne.h"].parents if parent.name == "geogram1")
    tbb = next(path for name, path in files.items() if name.startswith("libtbb"))
    with replacing(built) as partial:
        command = [compiler, "-std=c++17", "-O2", "-fPIC", "-shared", str(SOURCE), f"-I{includes}", str(static)]
        command += [str(tbb), f"-Wl,-rpath,{tbb.parent}", "-lpthread", "-ldl", "-fopenmp", "-o", str(partial)]
        made = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603
        if made.returncode:
            raise UsageError("Geogram's functions cannot be compiled.", made.stderr.strip().splitlines()[-1])
    return built


# Loaded with the module, so that no run includes the time of the compiler.
_LIBRARY = ctypes.CDLL(str(_compiled()))
_LIBRARY.hdpea_vertex_count.restype = _LIBRARY.hdpea_face_count.restype = ctypes.c_int64
