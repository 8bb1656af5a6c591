# SPDX-License-Identifier: GPL-3.0-or-later
"""What came out of a run: the mesh checked, and measured against the points it was made of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import HdpeaError
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.budget import Budget
from hdpea.mesh.error_bound import ErrorBound
from hdpea.mesh.extraction import Mesh
from hdpea.options import MeshingOptions
from hdpea.report.agreement import Agreement, agreement_of, distances_to
from hdpea.report.facts import Distances, HeightDifferences, LevelFacts, MeshFacts
from hdpea.report.heights import height_differences, is_height_field
from hdpea.surface.preparation import Preparation

HARDLY_SHOWN = 0.01
"""Root mean square distance of the points to the mesh, in diagonals, from which on a mesh is said to be too coarse.

Of six training meshes, 5,000 points each, it is 0.014 to 0.097 with 5 vertices, 0.005 to 0.014 with 20, and below 0.003
with 50 on those whose mesh comes out whole."""

FARTHEST = 1.5
"""Distance of a point from the mesh, in spacings of its vertices, from which on it is said that a part may be missing.

Of the 20 validation meshes, 40,000 points each, it is 1.3 at most with 5,180 vertices and 0.7 with 1,500 and 500; of
an animal that loses its tail, 2.6."""

LEAST_TOLD = 0.001
"""Share of the points without mesh that is told."""

MOST_CUT = 0.03
"""Pairs of faces that cut each other, for each face, from which on a mesh is none of a surface.

Of 60 raw clouds it is 0.3 % at most, of CGAL's building.ply, noisy terraces from the air, 2.3 %; of scans out of
register, strays taken for surface, and sensors of another cloud, where it is more, a third and more faced the wrong
way."""


def mesh_facts(mesh: Mesh) -> MeshFacts:
    """Check a mesh, by code that its construction has no part in.

    Raises
    ------
    HdpeaError
        If it is not manifold and oriented: such a mesh is an error of hdpea's, and never leaves.
    """
    check = _core.check_mesh(mesh.vertices_in_unit, mesh.faces)
    if not (check.manifold and check.oriented):
        raise HdpeaError("The mesh is not manifold.", "This is an error in hdpea: please report it with the input.")
    cuts = mesh.self_intersections
    if cuts is None:
        cuts = _core.count_self_intersections(mesh.vertices_in_unit, mesh.faces)
    return MeshFacts(
        vertices=check.vertices,
        faces=check.faces,
        manifold=check.manifold,
        closed=check.closed,
        components=check.components,
        boundary_loops=check.boundary_loops,
        genus=check.genus if check.closed else None,
        self_intersections=cuts,
    )


class Comparison(NamedTuple):
    """A mesh next to its points: how far these are, as they were given, and what either has alone, as embedded.

    ``farthest`` is the largest of the distances (n,) ``of_embedded`` points from the mesh, in spacings of its vertices;
    they themselves are in the unit frame. ``along_z`` is None unless the mesh is a height field. ``pieces_left_out`` is
    how many were too small to be kept.
    """

    distances: Distances
    agreement: Agreement
    farthest: float
    of_embedded: NDArray[np.float64]
    along_z: HeightDifferences | None = None
    pieces_left_out: int = 0

    def missing_part(self) -> Iterator[str]:
        """Yield a sentence if a part of the points may have no mesh."""
        yield from missing_part(self.distances, self.farthest, self.agreement.points_without_mesh, self.pieces_left_out)


def missing_part(distances: Distances, farthest: float, without: float, pieces_left_out: int) -> Iterator[str]:
    """Yield a sentence if points may have no mesh: the `farthest` lies so many spacings of vertices off.

    That share of them is `without` any near.
    """
    if farthest <= FARTHEST:
        return
    why = "More `particles` show thinner parts."
    if pieces_left_out:
        some = "1 piece" if pieces_left_out == 1 else f"{pieces_left_out:,} pieces"
        why = f"{some} of few faces left out: `min_component` 0 keeps such, more `vertices` show them."
    share = f"; {without:.1%} have none near" if without >= LEAST_TOLD else ""
    yield (
        f"A part may be missing: points lie up to {distances.max:.3g} from the mesh, {farthest:.1f} "
        f"times as far as its vertices are apart{share}. {why}"
    )


def compare(mesh: Mesh, prepared: Preparation, vertices: int) -> Comparison:
    """Compare a mesh of so many `vertices` with its points."""
    given, embedded = prepared.oriented.surface, prepared.surface
    distances, of_embedded = _distances(mesh, prepared)
    diagonal = given.frame.diagonal
    return Comparison(
        Distances.of(distances * diagonal, given.spacing * diagonal),
        agreement_of(mesh, embedded, vertices, of_embedded),
        in_spacings_of_vertices(float(of_embedded.max()), mesh),
        of_embedded,
        HeightDifferences.of(height_differences(mesh, given, distances) * diagonal) if is_height_field(mesh) else None,
        int(mesh.statistics.get("dropped_components", 0)),
    )


def in_spacings_of_vertices(distance: float, mesh: Mesh) -> float:
    """Return a distance, in the unit frame, in sides of the square that each vertex of a mesh has; 0 of no area."""
    apart = float(np.sqrt(mesh_area(mesh.vertices_in_unit, mesh.faces) / len(mesh.vertices_in_unit)))
    return distance / apart if apart > 0 else 0.0


def _distances(mesh: Mesh, prepared: Preparation) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how far the points (n,) are from a mesh, as they were given and as embedded, in the unit frame."""
    given, embedded = prepared.oriented.surface, prepared.surface
    distances = distances_to(mesh, given)
    return distances, distances if embedded is given else distances_to(mesh, embedded)


def coarseness(distances: Distances, diagonal: float, options: MeshingOptions) -> Iterator[str]:
    """Yield a sentence if the mesh has so few vertices, as was asked for, that it hardly shows the shape."""
    share = distances.rms / diagonal if diagonal > 0 else 0.0
    if share > HARDLY_SHOWN and not options.any_size:
        yield (
            f"So few vertices hardly show the shape: the points are {share:.1%} of its size off the mesh (rms). "
            "Ask for more, or leave the number to hdpea."
        )


def level_facts(mesh: Mesh, prepared: Preparation) -> LevelFacts:
    """Check a coarser level of a mesh, and measure it against the points as the mesh itself is.

    Raises
    ------
    HdpeaError
        If it is not manifold and oriented.
    """
    facts = mesh_facts(mesh)
    given, diagonal = prepared.oriented.surface, prepared.surface.frame.diagonal
    distances, of_embedded = _distances(mesh, prepared)
    reached = ErrorBound(prepared.surface, 0.0).reached(mesh, distances=of_embedded).in_world(diagonal)
    rms = Distances.of(distances * diagonal, given.spacing * diagonal).rms
    return LevelFacts(facts.vertices, facts.faces, rms, reached.larger)


def missed_targets(mesh: Mesh, facts: MeshFacts, options: MeshingOptions) -> Iterator[str]:
    """Yield a sentence for each wish that the mesh does not meet."""
    budget = Budget.of(options)
    excess = budget.excess(mesh)
    # With an error, the number is the most there may be.
    if excess > 0:
        yield f"{budget.comparison(mesh).removesuffix('.')}: ask for more."
    elif excess < 0 and options.error is None:
        yield budget.comparison(mesh)
    if options.watertight and not facts.closed:
        yield f"The mesh is not watertight: {facts.boundary_loops} boundary loops are left."
    # What closes a wide gap is a guess, and may lie in what it closes.
    if not options.watertight and facts.self_intersections > MOST_CUT * len(mesh.faces):
        count = f"{facts.self_intersections:,} pairs of {len(mesh.faces):,} faces cut others"
        asked = not options.any_size and mesh.statistics.get("edges_collapsed", 0) > 0
        unfit = "the points are too few for it, on no surface, or of scans that do not meet"
        why = "so few cannot show it; ask for more" if asked else unfit
        yield f"{count}: {why}."
