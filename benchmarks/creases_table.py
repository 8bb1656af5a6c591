# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of the true creases a mesh shows as edges, and how many of its sharp edges lie on a true crease.

    python benchmarks/creases_table.py [--models cube,anchor] [--normals estimate] [--noise 0.2] [--save DIR]

Each model is sampled (40,000 points, seeded by its name) and reconstructed from the points. The true creases are the
edges of dihedral over 40 degrees of the true mesh; the sharp edges of the reconstruction are those over 30 degrees.
Recall is the share of the true length with a sharp edge within a quarter of the point spacing and 10 degrees of its
direction; precision the share of the sharp edges' length with a true crease so near. A spacing is the square root of
the area per point. Smooth models must have no crease edges in the report. Prints Markdown.
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from val_table import ROOT, read_mesh

from hdpea import reconstruct
from hdpea.options import MeshingOptions, NormalOptions, Options
from hdpea.writing.meshes import write_mesh

SHARP_MODELS = ("demo/fandisk", "val/anchor", "val/double_block", "val/trident_idler_housing", "cube", "cylinder")
SMOOTH_MODELS = ("val/bull", "val/goat_head", "demo/kitten")
POINTS = 40_000
TRUE_DIHEDRAL, FOUND_DIHEDRAL, DIRECTION = 40.0, 30.0, 10.0
"""Degrees."""

NEAR = 0.25
"""Spacings."""

SAMPLES = 8
"""Of a crease, for each spacing."""

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Lines:
    """Evenly spread places (n, 3) of creases, their unit directions (n, 3), and the ends (n, 2, 3) of their edges."""

    places: Floats
    directions: Floats
    ends: Floats

    @classmethod
    def of(cls, mesh: trimesh.Trimesh, dihedral: float, step: float) -> Lines:
        """Take places a step apart on the edges of a dihedral, in degrees, or more."""
        edges = mesh.face_adjacency_edges[mesh.face_adjacency_angles > np.radians(dihedral)]
        ends = mesh.vertices[edges].astype(float).reshape(-1, 2, 3)
        offsets = ends[:, 1] - ends[:, 0]
        lengths = np.linalg.norm(offsets, axis=1)
        # One every step along all edges one after the other: an edge has as many as it is long.
        stops = np.arange(step / 2, lengths.sum(), step)
        starts = np.concatenate([[0], np.cumsum(lengths)])
        rows = np.searchsorted(starts, stops, side="right") - 1
        along = (stops - starts[rows]) / lengths[rows]
        return cls(ends[rows, 0] + along[:, None] * offsets[rows], offsets[rows] / lengths[rows, None], ends[rows])

    def shown_by(self, others: Lines, spacing: float) -> NDArray[np.bool_]:
        """Tell which places have one of the other edges near and in their direction."""
        shown = np.zeros(len(self.places), bool)
        if len(others.places) == 0 or len(shown) == 0:
            return shown
        reach = (NEAR + 1 / SAMPLES) * spacing
        near = cKDTree(others.places).query_ball_point(self.places, reach)
        rows = np.repeat(np.arange(len(near)), [len(each) for each in near])
        found = np.concatenate([np.asarray(each, int) for each in near])
        a, b = others.ends[found, 0], others.ends[found, 1]
        along = np.einsum("nc,nc->n", self.places[rows] - a, b - a) / np.square(b - a).sum(axis=1)
        feet = a + along.clip(0, 1)[:, None] * (b - a)
        close = np.linalg.norm(self.places[rows] - feet, axis=1) <= NEAR * spacing
        cosines = abs(np.einsum("nc,nc->n", self.directions[rows], others.directions[found]))
        shown[rows[close & (cosines >= np.cos(np.radians(DIRECTION)))]] = True
        return shown


def true_mesh(model: str, meshes: Path) -> trimesh.Trimesh:
    """Read a model of the folder, or make it: of a size of about 1."""
    if model == "cube":
        return trimesh.creation.box((1, 1, 1))
    if model == "cylinder":
        return trimesh.creation.cylinder(0.4, 1, sections=256)
    return trimesh.Trimesh(*read_mesh(meshes / f"{model}.ply"), process=False)


def sample(mesh: trimesh.Trimesh, model: str, noise: float) -> tuple[Floats, Floats, float]:
    """Return points and normals (n, 3), and their spacing; noise is in spacings."""
    seed = zlib.crc32(model.encode()) % 100_000
    points, faces = trimesh.sample.sample_surface(mesh, POINTS, seed=seed)
    spacing = float(np.sqrt(mesh.area / POINTS))
    shifts = noise * spacing * np.random.default_rng(seed).normal(size=points.shape)
    return np.asarray(points) + shifts, np.asarray(mesh.face_normals[faces]), spacing


def rows(models: list[str], meshes: Path, noise: float, options: Options, save: Path | None) -> Iterator[list[str]]:
    """Reconstruct and measure each model."""
    for model in models:
        truth = true_mesh(model, meshes)
        points, normals, spacing = sample(truth, model, noise)
        start = time.perf_counter()
        result = reconstruct(points, None if options.normals.normals == "estimate" else normals, options)
        seconds = time.perf_counter() - start
        if save:
            write_mesh(save / f"{Path(model).name}.ply", result.vertices, result.faces)
        true = Lines.of(truth, TRUE_DIHEDRAL, spacing / SAMPLES)
        found_mesh = trimesh.Trimesh(result.vertices, result.faces, process=False)
        found = Lines.of(found_mesh, FOUND_DIHEDRAL, spacing / SAMPLES)
        shares = [each.shown_by(other, spacing) for each, other in ((true, found), (found, true))]
        recall, precision = (f"{each.mean():.1%}" if len(each) else "" for each in shares)
        crease_edges = result.report.meshing["crease_edges"]
        cuts = result.report.mesh.self_intersections
        yield [Path(model).name, recall, precision, str(crease_edges), str(cuts), f"{seconds:.1f}"]


@click.command()
@click.argument("meshes", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes")
@click.option("--models", help="only these, by name: cube,anchor")
@click.option("--vertices", default=5180, show_default=True)
@click.option("--normals", default="auto", show_default=True, help="estimate: from the points alone")
@click.option("--noise", default=0.0, show_default=True, help="standard deviation, in spacings")
@click.option("--save", type=click.Path(path_type=Path), help="folder for the meshes")
def main(*, meshes: Path, models: str | None, vertices: int, normals: str, noise: float, save: Path | None) -> None:
    """Measure the creases of the models in MESHES."""
    wanted = [model for model in SHARP_MODELS + SMOOTH_MODELS if not models or Path(model).name in models.split(",")]
    if save:
        save.mkdir(parents=True, exist_ok=True)
    options = Options(meshing=MeshingOptions(vertices=vertices), normals=NormalOptions(normals=normals))
    click.echo("| model | recall | precision | crease edges | self-intersections | seconds |")
    click.echo("|---|---|---|---|---|---|")
    for row in rows(wanted, meshes, noise, options, save):
        click.echo("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
