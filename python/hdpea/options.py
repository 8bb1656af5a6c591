# SPDX-License-Identifier: GPL-3.0-or-later
"""One options dataclass per stage: the only home of every default.

The command line, the Python signatures and the report read these fields; ``help`` is the text that
``hdpea reconstruct --help`` shows. An illegal value is a ``UsageError`` the moment it is given.
This module imports nothing heavy, so that help stays instant.
"""

from __future__ import annotations

from dataclasses import Field, dataclass, field, fields
from typing import Any

from hdpea.errors import UsageError
from hdpea.lengths import Length
from hdpea.position import Position

POINTS_PER_VERTEX = 8
"""How many points share a vertex unless a number of vertices or faces is asked for."""

ENOUGH_PARTICLES, ENOUGH_PER_VERTEX = 20_000, 2
"""As many particles show any surface, or so many for each vertex of its mesh: more points do not make them more."""

WORTH_SIMPLIFYING = 1.2
"""From so many particles for each vertex on, their mesh simplified errs less; with fewer, G is lost for nothing."""


def option(default: Any, help: str, **metadata: Any) -> Any:
    """Return a dataclass field that carries its help text and what is legal: ``choices``, ``minimum``, ``maximum``."""
    return field(default=default, metadata={"help": help, **metadata})


def _check(field: Field[Any], value: Any) -> None:
    choices = field.metadata.get("choices")
    minimum, maximum = field.metadata.get("minimum"), field.metadata.get("maximum")
    if choices is not None and value not in choices:
        raise UsageError(f"{field.name} is one of {', '.join(choices)}, not {value!r}.")
    # Written so that NaN is refused too.
    if minimum is not None and value is not None and not value >= minimum:
        raise UsageError(f"{field.name} is at least {minimum}, not {value}.")
    if maximum is not None and value is not None and not value <= maximum:
        raise UsageError(f"{field.name} is at most {maximum}, not {value}.")


@dataclass(frozen=True)
class Checked:
    """Base of the options: checks every value against its field's choices, minimum and maximum."""

    def __post_init__(self) -> None:
        for each in fields(self):
            _check(each, getattr(self, each.name))


@dataclass(frozen=True)
class NormalOptions(Checked):
    """How normals are had (``hdpea.normals``)."""

    normals: str = option(
        "auto",
        "auto: the file's where they are usable, else estimated; file: the file's or fail; estimate: always estimate",
        choices=("auto", "file", "estimate"),
    )
    normal_neighbors: int | None = option(
        None,
        "nearest points whose plane gives an estimated normal; default: two for each point per particle, 16 to 40; "
        "to 80 if the points are noisy",
        minimum=3,
    )
    orient: str = option(
        "auto",
        "which side is out. auto: the file's normals say where neighbours agree, else wnnc or mst, by which more "
        "neighbours agree; wnnc: by the winding number, for closed shapes; mst: from neighbour to "
        "neighbour along a spanning tree; file: as in the file; viewpoint: towards the sensor",
        choices=("auto", "wnnc", "mst", "file", "viewpoint"),
    )
    viewpoint: Position | None = option(
        None,
        "X,Y,Z of the sensor, in the units of the file, for --orient viewpoint; default: each point's own, "
        "from the file's sensor_x, sensor_y and sensor_z, or array sensor",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.viewpoint is not None and self.orient != "viewpoint":
            raise UsageError(
                f"A viewpoint is of no use with orient {self.orient}.", "Add --orient viewpoint, or leave it out."
            )


ROUGH = 0.15
"""Roughness, in spacings of the points, from which moving least squares mends more than it blurs."""

FEWEST_FITTED, MOST_FITTED = 80, 320
"""Neighbours that moving least squares fits, by how rough the points are: with more, less noise is left, and less of
what bends."""


@dataclass(frozen=True)
class DenoisingOptions(Checked):
    """How noise is taken from the points (``hdpea.denoising``)."""

    denoise: str = option(
        "auto",
        "mls: first move each point onto the quadric that fits its neighbours (moving least squares); auto: if the "
        f"points are more than {ROUGH:g} of their spacing off a smooth surface",
        choices=("auto", "none", "mls"),
    )
    denoise_neighbors: int | None = option(
        None,
        f"mls: nearest points that it is fitted to; default: from {FEWEST_FITTED} to {MOST_FITTED}, "
        "by how rough they are",
        minimum=6,
    )


@dataclass(frozen=True)
class EmbeddingOptions(Checked):
    """How the cloud is embedded in R^8 (``hdpea.embedding``)."""

    embedding: str = option(
        "direct",
        "direct: solved for on this cloud; learned: by a trained network, at once",
        choices=("direct", "learned"),
    )
    weights: str | None = option(
        None, "learned: file of the network's weights, as `hdpea train` writes it; default: those that come along"
    )
    whole_points: int = option(
        80_000, "learned: clouds of more points are embedded in patches that are joined (PMEI)", minimum=1
    )
    curvature_radius: Length | None = option(
        None,
        "direct: radius in which curvature is measured, as 0.02 or 1%; default: from the number of particles",
    )
    bending_length: Length | None = option(
        None, "direct: length below which it does not bend, as 0.02 or 1%; default: from the number of particles"
    )
    metric_scale: float = option(0.5, "direct: c of the metric s^2 = c |k|: larger stretches more", minimum=0)
    max_stretch: float = option(8.0, "direct: largest stretch of the metric in any direction", minimum=1)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.weights is not None and self.embedding != "learned":
            raise UsageError(
                f"The {self.embedding} embedding has no use for weights.", "Give --embedding learned as well."
            )


@dataclass(frozen=True)
class ParticleOptions(Checked):
    """How particles are spread (``hdpea.particles``)."""

    particles: int | None = option(
        None,
        "particles to spread; their mesh is simplified where fewer vertices are wanted; default: one for every "
        f"{POINTS_PER_VERTEX} points, at most {ENOUGH_PARTICLES:,} or {ENOUGH_PER_VERTEX} for each vertex",
        minimum=4,
    )
    iterations: int = option(100, "steps of the particles' energy descent", minimum=0)
    seed: int = option(0, "seed of everything random; the same seed gives the same bytes", minimum=0)


@dataclass(frozen=True)
class MeshingOptions(Checked):
    """How the particles become a mesh (``hdpea.meshing``)."""

    vertices: int | None = option(
        None, f"vertices wanted; default: one for every {POINTS_PER_VERTEX} points", minimum=4
    )
    faces: int | None = option(None, "faces wanted, instead of --vertices", minimum=4)
    fill_holes: Length | None = option(
        None, "fill holes up to this size across, as 0.02 or 1%; default: 4 times the spacing of the particles; 0: none"
    )
    watertight: bool = option(False, "close every hole, whatever its size")
    min_component: int = option(
        16,
        "drop connected pieces of fewer faces than this, or of as small a share of the mesh that is to be simplified; "
        "the largest stays",
        minimum=0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.vertices is not None and self.faces is not None:
            raise UsageError("Vertices and faces exclude each other.", "Ask for one; the other follows from it.")

    @property
    def any_size(self) -> bool:
        """Whether no number of vertices or faces is asked for."""
        return self.vertices is None and self.faces is None

    def vertices_of(self, points: int) -> int:
        """Return how many vertices to make of so many points: a closed mesh has two faces for each."""
        if self.vertices is not None:
            return self.vertices
        return self.faces // 2 + 2 if self.faces is not None else max(points // POINTS_PER_VERTEX, 12)


@dataclass(frozen=True)
class RefinementOptions(Checked):
    """How the mesh is fitted to the points afterwards (``hdpea.refinement``)."""

    refine: bool = option(True, "fit the vertices to the points by least squares")
    rounds: int = option(2, "rounds of projection and fitting", minimum=0)


@dataclass(frozen=True)
class Options(Checked):
    """Everything ``hdpea.reconstruct`` can be told."""

    normals: NormalOptions = NormalOptions()
    denoising: DenoisingOptions = DenoisingOptions()
    embedding: EmbeddingOptions = EmbeddingOptions()
    particles: ParticleOptions = ParticleOptions()
    meshing: MeshingOptions = MeshingOptions()
    refinement: RefinementOptions = RefinementOptions()
    threads: int = option(0, "threads to use; 0: all cores (the result is the same for any number)", minimum=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        given = self.particles.particles
        if given is not None and given < (vertices := self.vertices_of(given)):
            raise UsageError(
                f"{given} particles cannot make {vertices} vertices.", "Spread at least one particle for each vertex."
            )

    def vertices_of(self, points: int) -> int:
        """Return how many vertices to make of so many points."""
        given = self.particles.particles
        if given is not None and self.meshing.any_size:
            return given
        return self.meshing.vertices_of(points)

    def particles_of(self, points: int) -> int:
        """Return how many particles to spread on so many points: at least one for each vertex.

        A mesh of few vertices is not made of few particles, which cannot show parts thinner than they are apart: it
        is simplified from a mesh of more.
        """
        if self.particles.particles is not None:
            return self.particles.particles
        vertices = self.meshing.vertices_of(points)
        shown = min(points // POINTS_PER_VERTEX, max(ENOUGH_PARTICLES, ENOUGH_PER_VERTEX * vertices))
        return shown if shown >= WORTH_SIMPLIFYING * vertices else vertices
