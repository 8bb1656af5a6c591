# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds that a run in one piece has no memory for."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from hdpea.errors import UsageError

if TYPE_CHECKING:
    from hdpea.options import Options
    from hdpea.reading.streaming import PointStream

DEFAULT_SHARE = 0.5
"""Share of the memory of the machine that is taken unless a size is given."""

UNITS = {"kb": 1e3, "mb": 1e6, "gb": 1e9, "tb": 1e12, "b": 1.0}


class MemoryType(click.ParamType[float]):
    """A size such as ``4GB`` or ``500MB``, in bytes."""

    name = "size"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the bytes; a usage error if it is no size."""
        text = str(value).strip().lower()
        unit = next((each for each in UNITS if text.endswith(each)), "")
        try:
            size = float(text.removesuffix(unit)) * UNITS.get(unit, 1.0)
        except ValueError:
            size = 0.0
        if not 0 < size < float("inf"):
            self.fail(f"{value!r} is not a size such as 4GB.", param, ctx)
        return size


@dataclass(frozen=True)
class Resources:
    """What a run may take.

    Attributes
    ----------
    memory
        Bytes; None: half of what the machine has.
    jobs
        Processes that work on tiles.
    scheduler
        Address of a Dask scheduler whose workers do so instead.
    folder
        Where tiles are kept meanwhile; default: beside the mesh.
    """

    memory: float | None = None
    jobs: int = 1
    scheduler: str | None = None
    folder: Path | None = None

    def bytes(self) -> float:
        """Return how much memory may be taken."""
        if self.memory is not None:
            return self.memory
        return DEFAULT_SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")

    def suffice(self, points: int, options: Options, *, normals: bool) -> bool:
        """Return whether a cloud of so many points, with `normals` or without, can be worked on in one piece."""
        from hdpea.report.cost import PEAK_BYTES, most_bytes

        used = normals and options.normals.normals != "estimate"
        return most_bytes(PEAK_BYTES.of(points, options.vertices_of(points)), normals=used) <= self.bytes()

    def work_folder(self, output: Path | None) -> Path:
        """Return where the tiles of a mesh are kept meanwhile.

        Raises
        ------
        UsageError
            If the mesh has no name, and the folder neither.
        """
        if self.folder is not None:
            return self.folder
        if output is None:
            raise UsageError("A cloud in tiles needs a folder for the work.", "Name the mesh, or `work_dir`.")
        return output.with_name(f"{output.name}.tiles")


def stream_beyond(sources: tuple[str, ...], options: Options, resources: Resources) -> PointStream | None:
    """Return the stream of a file that can be streamed and is too large for one piece; None of any other."""
    from hdpea.reading.streaming import stream_of

    stream = stream_of(Path(sources[0])) if len(sources) == 1 else None
    if stream is None or resources.suffice(stream.count, options, normals=stream.normals):
        return None
    return stream
