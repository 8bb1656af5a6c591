# SPDX-License-Identifier: GPL-3.0-or-later
"""From a cleaned cloud to the oriented surface that is embedded: normals, which side is out, denoising."""

from __future__ import annotations

from dataclasses import dataclass, replace

from hdpea.errors import core_errors_translated
from hdpea.frontend.registration import Met, moved_together
from hdpea.frontend.volume import fills_a_volume
from hdpea.options import DenoisingOptions, NormalOptions
from hdpea.options.choice import Choice
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.reading.cloud import PointCloud
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback
from hdpea.surface.denoising import denoised
from hdpea.surface.given_normals import GivenNormals, judged_normals
from hdpea.surface.normals import OrientedSurface, oriented_surface
from hdpea.surface.surface import Surface


@dataclass(frozen=True)
class Preparation:
    """A surface ready to be embedded, and how it was prepared.

    Attributes
    ----------
    surface
        What is embedded: denoised, if the options or the noise ask for it.
    oriented
        The same before denoising, with how it came by its normals. Both have one frame and one order of the points.
    choices
        What was chosen automatically, in the order of the stages.
    notes
        Sentences for the user about this cloud.
    missed
        Why no mesh of it can be what is wanted, if so: a sentence for each reason.
    """

    surface: Surface
    oriented: OrientedSurface
    choices: tuple[Choice, ...]
    notes: tuple[str, ...]
    missed: tuple[str, ...] = ()

    @property
    def denoised(self) -> bool:
        """Whether the points were moved to where they are."""
        return self.surface is not self.oriented.surface

    @property
    def exact(self) -> bool:
        """Whether the points are as they were given, and so are most of their normals."""
        return not self.denoised and 2 * self.oriented.estimated < len(self.surface.normals)


def prepare_surface(
    cloud: PointCloud,
    normals: NormalOptions | None = None,
    denoising: DenoisingOptions | None = None,
    points_per_vertex: float = POINTS_PER_VERTEX,
    progress: ProgressCallback | None = None,
    clock: StageClock | None = None,
) -> Preparation:
    """Prepare a cleaned cloud, as ``hdpea.reading`` returns it, for the embedding.

    Parameters
    ----------
    denoising
        None leaves the points where they are. Where it is to be found out, two scans that do not meet are moved
        together, of points without normals that are taken for such.
    points_per_vertex
        As of ``hdpea.surface.normals.oriented_surface``.
    progress
        Hears of the phases normals and denoising.
    clock
        Measures them as stages.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    UnreadableInput
        If the file's normals, or their signs, are insisted on and unusable.
    UsageError
        If normals are to be turned to a viewpoint and there is none.
    """
    clock = clock or StageClock()
    with clock.stage("normals"):
        normals = normals or NormalOptions()
        given = judged_normals(cloud.points, cloud.normals, normals)
        met = _scans_that_met(cloud, given, denoising)
        if met is not None:
            cloud = replace(cloud, points=met.points)
        oriented = oriented_surface(cloud.points, given, normals, points_per_vertex, progress, cloud.sensors())
    surface, choices = oriented.surface, oriented.choices
    if denoising is not None:
        with clock.stage("denoising"):
            surface, chosen = denoised(oriented, denoising, progress)
            choices += chosen
    with core_errors_translated():
        solid = fills_a_volume(oriented.surface.points_in_unit, oriented.roughness)
    missed = ("The points fill a volume: they show no surface.",) if solid else ()
    notes = _notes(cloud, oriented)
    if met is not None:
        notes.append(f"Two scans lay {met.apart:.3g} apart: they were moved together, each half of the way.")
    return Preparation(surface, oriented, choices, tuple(notes), missed)


def _scans_that_met(cloud: PointCloud, given: GivenNormals, denoising: DenoisingOptions | None) -> Met | None:
    """Move two scans together, if points may be moved and no normals tell whether layers are walls."""
    if denoising is None or denoising.denoise != "auto" or given.usable.any():
        return None
    with core_errors_translated():
        return moved_together(cloud.points)


def _notes(cloud: PointCloud, oriented: OrientedSurface) -> list[str]:
    notes = []
    if oriented.refused and oriented.estimated == len(cloud.points):
        notes.append("The given normals do not lie across the surface of the points: they were estimated instead.")
    elif oriented.refused:
        which = f"{oriented.refused:,} of the given normals do not lie across the surface of the points"
        notes.append(f"{which}: normals of {oriented.estimated:,} points were estimated.")
    elif oriented.estimated > cloud.unusable_normals:
        notes.append(f"Normals of {oriented.estimated:,} points were estimated.")
    signs = oriented.signs
    if oriented.method != "file" and signs is not None and not signs.trusted:
        share = f"{signs.consistency:.0%} of neighbours agreed{', patch by patch' if signs.patchy else ''}"
        notes.append(f"The given normals point both ways ({share}); they were oriented anew.")
    if oriented.sensors_refused:
        notes.append("The sensors cannot have seen the points, which lie behind others from there: they do not count.")
    if oriented.from_one_place:
        # That it is the origin is told by the points alone, which ground above the origin resembles, too.
        known = cloud.sensors() is not None and not oriented.sensors_refused
        place = "one place" if known else "one place, the origin, unless `orient` or `viewpoint` says otherwise"
        notes.append(f"The points were seen from {place}: what cannot be seen from there is missing.")
    return notes
