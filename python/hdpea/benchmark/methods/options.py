# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of the other methods."""

from __future__ import annotations

import shlex
import sys
from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options import Checked, option
from hdpea.reading.triangle_mesh import SURFACE_FORMATS

TOLERANCE = 0.01
"""Relative deviation from the wanted number of vertices that is accepted, as for hdpea itself."""

ATTEMPTS = 4
"""Attempts to meet the number: methods take faces or clusters, whose ratio to vertices depends on the mesh."""


@dataclass(frozen=True)
class ReducedOptions(Checked):
    """How a mesh of too many vertices is reduced to the wanted number."""

    reduce: str = option(
        "fast",
        "fast: quadric edge collapse by fast-simplification; quadric: by MeshLab; acvd: centroidal Voronoi clusters "
        "by pyacvd; cvt: anisotropic centroidal Voronoi remeshing by Geogram; mmg: anisotropic remeshing "
        "by mmgs; none: not at all",
        choices=("fast", "quadric", "acvd", "cvt", "mmg", "none"),
    )


@dataclass(frozen=True)
class PoissonOptions(ReducedOptions):
    """Screened Poisson reconstruction (Kazhdan and Hoppe, 2013), by MeshLab."""

    depth: int = option(8, "depth of the octree", minimum=1, maximum=14)
    trim: float = option(
        0.0,
        "levels of the octree below that of the median vertex from which on surface is cut away, as is usual for open "
        "scans; 0: no trimming",
        minimum=0,
    )


@dataclass(frozen=True)
class AdvancingFrontOptions(ReducedOptions):
    """Advancing front (Cohen-Steiner and Da, 2004), by CGAL."""


@dataclass(frozen=True)
class BallPivotingOptions(ReducedOptions):
    """The ball-pivoting algorithm (Bernardini et al., 1999), by MeshLab."""

    radius: float = option(
        0.0,
        "radius of the ball, in percent of the diagonal; 0: the mean distance to the sixth neighbour, then twice that",
        minimum=0,
    )


@dataclass(frozen=True)
class Co3neOptions(ReducedOptions):
    """Concurrent co-cones (Boltcheva and Levy, 2017), by Geogram."""

    radius: float = option(5.0, "radius within which points are connected, in percent of the diagonal", minimum=0)


@dataclass(frozen=True)
class FolderOptions(Checked):
    """Meshes made elsewhere."""

    path: str = option("", "path of the meshes, containing {model}, {input} and {vertices}, such as ndc/{model}.obj")

    def __post_init__(self) -> None:
        super().__post_init__()
        if "{model}" not in self.path:
            raise UsageError("The path of a folder of meshes has no {model} in it.", "Such as ndc/{model}.obj")


@dataclass(frozen=True)
class CommandOptions(Checked):
    """Any program."""

    run: str = option(
        "",
        "program and arguments, containing {points} (a PLY file) and {mesh}, optionally {vertices} and {python}",
    )
    format: str = option(".ply", "format of the mesh that it writes", choices=SURFACE_FORMATS)
    folder: str = option("", "folder in which it runs, relative to that of the suite, which is the default")

    def __post_init__(self) -> None:
        super().__post_init__()
        if "{points}" not in self.run or "{mesh}" not in self.run:
            raise UsageError(
                "The command has no {points} or no {mesh} in it.", "Such as PoissonRecon --in {points} --out {mesh}"
            )
        self.words("", "", 0)

    def words(self, points: str, mesh: str, vertices: int) -> list[str]:
        """Return the program and its arguments for files and a number of vertices, split like a shell does."""
        filled = {"points": points, "mesh": mesh, "vertices": vertices, "python": sys.executable}
        try:
            return [word.format(**filled) for word in shlex.split(self.run)]
        except (KeyError, IndexError, ValueError) as error:
            raise UsageError(
                f"The command {self.run!r} cannot be filled in: {error}.", f"Known are {', '.join(filled)}, in braces."
            ) from error
