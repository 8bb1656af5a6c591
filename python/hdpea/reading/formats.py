# SPDX-License-Identifier: GPL-3.0-or-later
"""The formats of point clouds, told by the content of a file: the table of what is read, and of what is not."""

from __future__ import annotations

import codecs
import re
import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from tokenize import TokenError
from zipfile import BadZipFile

from plyfile import PlyParseError

from hdpea.errors import HdpeaError, UnreadableInput
from hdpea.reading.arrays import parse_npy, parse_npz
from hdpea.reading.cloud import PointCloud
from hdpea.reading.compression import GZIP, unzipped
from hdpea.reading.e57 import parse_e57
from hdpea.reading.las import parse_las
from hdpea.reading.meshes import parse_obj, parse_off
from hdpea.reading.pcd import parse_pcd
from hdpea.reading.ply import parse_ply
from hdpea.reading.ptx import PTX, parse_ptx
from hdpea.reading.text import UTF16, parse_text

TABLES = (".xyz", ".xyzn", ".txt", ".csv", ".asc", ".pts", ".pwn")

CLOUD_FORMATS = (
    ".ply", *TABLES, ".obj", ".off", ".npy", ".npz", ".las", ".laz", ".e57", ".pcd", ".ptx"
)  # fmt: skip
"""Extensions by which clouds are found in a folder; what a file holds is told by its content."""

READABLE = (
    "hdpea reads PLY, XYZ/TXT/CSV/PTS/PWN text, LAS, LAZ, E57, PCD, PTX, OBJ, OFF, NPY and NPZ; "
    "`pdal translate IN out.ply` and CloudCompare convert many others."
)


@dataclass(frozen=True)
class Format:
    """A format that is read.

    Attributes
    ----------
    name
        For people.
    content
        What a file of it begins with.
    parse
        From the bytes to the cloud.
    needs
        The modules beside hdpea's own that it takes, of ``hdpea[io]``.
    """

    name: str
    content: re.Pattern[bytes]
    parse: Callable[[bytes], PointCloud]
    needs: tuple[str, ...] = ()


_OBJ = Format(
    "OBJ",
    re.compile(
        rb"(?:\s+|#[^\n]*\n|(?:o|g|s|p|l|vp|lod|mtllib|maplib|usemtl|usemap|mg|cstype|deg)\b[^\n]*\n)*+v[nt]?\s"
    ),
    parse_obj,
)

FORMATS = (
    Format("PLY", re.compile(rb"ply\s"), parse_ply),
    Format("NPY", re.compile(rb"\x93NUMPY"), parse_npy),
    Format("NPZ", re.compile(rb"PK\x03\x04"), parse_npz),
    Format("LAS/LAZ", re.compile(rb"LASF"), parse_las, ("laspy", "lazrs")),
    Format("E57", re.compile(rb"ASTM-E57"), parse_e57, ("pye57",)),
    Format("PCD", re.compile(rb"(?:#[^\n]*\n|\s)*+(?:# \.PCD|VERSION\s+0?\.7\s)"), parse_pcd, ("pypcd4",)),
    Format("PTX", PTX, parse_ptx),
    # Possessive, since a file of nothing but blank lines has as many ways to match as it has lines.
    Format("OFF", re.compile(rb"(?:\s+|#[^\n]*\n)*+[STCN]*OFF\b"), parse_off),
    _OBJ,
)

_VERTEX = re.compile(rb"(?<![^\r\n])[ \t]*v(?:[ \t]+[-+.\deE]+){3}\s")
"""What makes a file an OBJ that is called one, whatever it begins with."""

STL = "an STL file, a mesh", "assimp export scan.stl scan.ply"

FOREIGN = (
    (re.compile(rb"PK\x03\x04.{26}(?:\[Content_Types\]|xl/)", re.DOTALL), "a spreadsheet",
     "soffice --convert-to csv scan.xlsx"),
    (re.compile(rb"\s*ncols\s+\d", re.IGNORECASE), "an ESRI grid, heights in rows rather than points",
     "gdal_translate -of XYZ dem.asc dem.xyz"),
    (re.compile(rb"DS[ABR]\w\s"), "a Surfer grid, heights in rows rather than points",
     "gdal_translate -of XYZ dem.grd dem.xyz"),
    (re.compile(rb"II\*\0|MM\0\*"), "a TIFF, an image or heights in rows", "gdal_translate -of XYZ dem.tif dem.xyz"),
    (re.compile(rb"glTF"), "a glTF file", "assimp export scan.glb scan.ply"),
    (re.compile(rb"solid\b"), *STL),
    (re.compile(rb"# vtk DataFile|<\?xml[^>]*>\s*<VTKFile|<VTKFile"), "a VTK file", "meshio convert scan.vtk scan.ply"),
    (re.compile(rb"#VRML|<\?xml[^>]*>\s*(?:<!DOCTYPE[^>]*>\s*)?<X3D"), "a VRML or X3D file",
     "meshlabserver -i scan.wrl -o scan.ply"),
    (re.compile(rb"NGSP"), "packed Gaussian splats", "splat-transform scan.spz scan.ply"),
    (re.compile(rb"DRACO"), "a Draco file", "draco_decoder -i scan.drc -o scan.ply"),
    (re.compile(rb"\x89HDF\r\n"), "an HDF5 file", "python -c \"import h5py, numpy; "
     "numpy.save('scan.npy', h5py.File('scan.h5')['points'][:])\""),
    (re.compile(rb"\s*[<{]"), "XML, HTML or JSON", "pdal translate IN out.ply"),
)  # fmt: skip
"""What is not read: what it begins with, what it is, and the command that converts it."""

DAMAGE = (
    PlyParseError,
    ValueError,
    LookupError,
    TypeError,
    ArithmeticError,
    OSError,
    EOFError,
    SyntaxError,
    TokenError,
    BadZipFile,
    RuntimeError,
    struct.error,
    zlib.error,
)
"""What the libraries that read those formats raise over nonsense."""


def is_binary_stl(data: bytes) -> bool:
    """Say whether data are as long as the number of triangles after the 80 bytes of an STL's header says."""
    return len(data) > 84 and len(data) == 84 + 50 * int.from_bytes(data[80:84], "little")


def parse_points(data: bytes, extension: str = "") -> PointCloud:
    """Read the content of a file, as ``read_points`` does, without dropping anything.

    Raises
    ------
    UnreadableInput
        If the content is damaged, of an unknown format, or empty, or the library that reads it is not installed.
    """
    if data.startswith(GZIP):
        data = unzipped(data)
    data = data.removeprefix(codecs.BOM_UTF8)
    if not data or data.isspace():
        raise UnreadableInput("it is empty.", "Save or export it again; it has no points yet.")
    foreign = _foreign(data)
    if foreign is not None:
        what, command = foreign
        raise UnreadableInput(f"it is {what}.", f"Convert it: {command}")
    known = next((each for each in FORMATS if each.content.match(data)), None)
    if known is None and extension == ".obj" and _VERTEX.search(data):
        known = _OBJ
    if known is not None:
        return _parsed(known, data)
    if b"\0" in data[:4096] and not data.startswith(UTF16):
        raise UnreadableInput("its format is unknown.", READABLE)
    return parse_text(data, normals_expected=extension in {".pwn", ".xyzn"})


def _foreign(data: bytes) -> tuple[str, str] | None:
    """Return what data are that no format of ``FORMATS`` reads, and the command that converts them, if it is known."""
    if is_binary_stl(data):
        return STL
    return next(((what, command) for prefix, what, command in FOREIGN if prefix.match(data)), None)


def _parsed(known: Format, data: bytes) -> PointCloud:
    missing = [module for module in known.needs if find_spec(module) is None]
    if missing:
        raise UnreadableInput(
            f"it is {known.name}, for which {' and '.join(missing)} must be installed.", "pip install 'hdpea[io]'"
        )
    # What the libraries of others raise is their business.
    expected = (Exception,) if known.needs else DAMAGE
    try:
        return known.parse(data)
    except (HdpeaError, MemoryError):
        raise
    except expected as error:
        # Some of them tell a story.
        reason = next(iter(str(error).strip().splitlines()), type(error).__name__)
        hint = "It may have been cut off while being copied."
        raise UnreadableInput(f"it is damaged {known.name} ({reason}).", hint) from error
