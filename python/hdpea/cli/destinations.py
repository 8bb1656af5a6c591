# SPDX-License-Identifier: GPL-3.0-or-later
"""Which arguments of ``hdpea reconstruct`` are clouds, and where each mesh goes; no scan is taken for an output."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from hdpea.cli.types import PATH
from hdpea.errors import HdpeaError, UsageError
from hdpea.runtime.marks import is_marked
from hdpea.runtime.names import nearest_name

STANDARD_STREAM = "-"
FORMATS = ("ply", "obj", "stl", "off", "glb")
"""Of meshes; the first is that of a mesh whose name is not given."""

SCAN_LIKE = (".ply", ".obj", ".off", ".npz")
"""Extensions of outputs that scans have, too."""


@dataclass(frozen=True)
class Destination:
    """The clouds, one or scans of one thing, and the file of the mesh of them; None: standard output."""

    sources: tuple[str, ...]
    output: Path | None
    extension: str

    @property
    def name(self) -> str:
        """What people call the output."""
        return "standard output" if self.output is None else str(self.output)


def destinations(files: Sequence[str], out_dir: Path | None, merge: bool, mesh_format: str | None) -> list[Destination]:
    """Sort the arguments of the command into clouds and meshes.

    Raises
    ------
    UsageError
        If they say too little, or what is in the place of the output looks like a scan.
    """
    if out_dir is not None:
        if merge:
            raise UsageError("`out_dir` has a mesh for each cloud, `merge` makes one of all.", "Give one of the two.")
        return _all_in_folder(files, out_dir, mesh_format)
    if len(files) == 1:
        return [_in_folder(files[0], Path(files[0]).parent, mesh_format)]
    word = next((each for each in files if "." not in each and not Path(each).exists() and each != "-"), None)
    if len(files) > 2 and word is not None:
        raise UsageError(f"There is no file {word}.", f"If it is an option, it begins with two dashes: --{word}")
    if len(files) > 2 and not merge:
        raise UsageError(f"There are {len(files)} files: it is not clear which are clouds.", _SEVERAL)
    *sources, last = files
    if last == STANDARD_STREAM:
        if mesh_format is None:
            raise UsageError("What is written to standard output needs a `mesh_format`.", "`mesh_format='ply'`, say.")
        return [Destination(tuple(sources), None, f".{mesh_format}")]
    output: Path = PATH.convert(last, None, None)
    if output.suffix[1:].lower() not in FORMATS:
        if output.is_file():
            raise UsageError(f"{output} is no name of a mesh, but a file that exists.", _hint_on(sources, output))
        if _is_no_cloud(sources):
            raise UsageError(f"{output} is no name of a mesh.", _hint_on(sources, nearest_name(output) or output))
    if mesh_format is not None and output.suffix.lower() != f".{mesh_format}":
        raise UsageError(f"{output} does not end in .{mesh_format}, its `mesh_format`.", "The extension says enough.")
    return [Destination(tuple(sources), output, output.suffix.lower())]


def _is_no_cloud(sources: Sequence[str]) -> bool:
    """Whether the only source is an STL, or is called like a mesh and is not there."""
    path = Path(sources[0])
    return len(sources) == 1 and path.suffix[1:].lower() in FORMATS and (path.suffix == ".stl" or not path.exists())


def _hint_on(sources: Sequence[str], scan: Path) -> str:
    """Return what to do where a scan is named in the place of a mesh."""
    first, *others = sources
    if not others and Path(first).suffix[1:].lower() in FORMATS:
        return f"The cloud comes first, then the mesh: {scan} {first}" + (
            f". {_SEVERAL}" if Path(first).suffix != ".stl" and Path(first).exists() else ""
        )
    return f"Name a mesh: {scan.stem}.{FORMATS[0]}, say. {_SEVERAL}"


def _all_in_folder(sources: Sequence[str], folder: Path, mesh_format: str | None) -> list[Destination]:
    found: dict[Path | None, Destination] = {}
    for source in sources:
        each = _in_folder(source, folder, mesh_format)
        if each.output in found:
            both = f"{found[each.output].sources[0]} and {source}"
            raise UsageError(f"The meshes of {both} would both be {each.output}.", "Give each a folder of its own.")
        found[each.output] = each
    return list(found.values())


_SEVERAL = "`out_dir` makes a mesh of each, `merge` one mesh, which is named last, of all the others."


def _in_folder(source: str, folder: Path, mesh_format: str | None) -> Destination:
    """Return the mesh of a cloud under the cloud's name with ``.mesh`` in it, so that it never is the cloud."""
    if source == STANDARD_STREAM:
        raise UsageError("Standard input has no name to call its mesh by.", "Name the mesh, or - for standard output.")
    name = Path(source).name.removesuffix(".gz")
    extension = f".{mesh_format or FORMATS[0]}"
    return Destination(
        (source,), PATH.convert(str(folder / f"{Path(name).stem}.mesh{extension}"), None, None), extension
    )


def require_no_scan(output: Path | None, kind: str = "mesh") -> None:
    """Refuse an output in the place of which a scan lies, as a pattern such as ``*.ply`` easily puts one there.

    Raises
    ------
    UsageError
        If it is a PLY, OBJ, OFF or NPZ that exists, has points and no faces, and that hdpea did not write as one of
        this kind.
    """
    try:
        is_scan = (
            output is not None
            and output.suffix.lower() in SCAN_LIKE
            and output.is_file()
            and not is_marked(output, kind)
            and _holds_points_alone(output)
        )
    except OSError as error:
        raise UsageError(f"Cannot write {output}: {error.strerror}.", "Choose another name.") from error
    if is_scan:
        hint = _SEVERAL if kind == "mesh" else "Remove it yourself if it may go."
        raise UsageError(f"{output} exists and holds points: it is taken for a scan, and never replaced.", hint)


def _holds_points_alone(path: Path) -> bool:
    from hdpea.reading import read_points
    from hdpea.reading.cloud import MESH_NOTE

    try:
        return MESH_NOTE not in read_points(path).notes
    except HdpeaError:
        return False
