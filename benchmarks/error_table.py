# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether `--error` is kept, and what it costs in triangles next to Poisson and quadric collapse.

    python benchmarks/error_table.py FOLDER [--meshes bull,trex] [--errors 2,1,0.5]

Each mesh of FOLDER is sampled (40,000 points with normals, seeded by its name) and reconstructed to each error, in
percent of the diagonal. Nothing here is shared with the implementation: distances to meshes are libigl's, the nearest
points SciPy's. Columns, in errors: the farthest point from the mesh, strays that were dropped apart; the farthest place
of the mesh from the plane of one of its 24 nearest points; the root mean square distance to the truth, the larger of
both ways. The rival is screened Poisson by MeshLab, depth 8, collapsed by fast-simplification to the same root mean
square distance (bisection); `never` where all its triangles do not reach it. Needs the `bench` dependency group and
`pip install 'hdpea[benchmark]'`.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import click
import igl
import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from hdpea import reconstruct
from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.options import PoissonOptions
from hdpea.benchmark.methods.poisson import surface as poisson
from hdpea.benchmark.methods.reduction import reduced

POINTS, SAMPLES = 40_000, 30_000
NEAREST = 24
CLOSE = 1.02
"""Ratio of the two ends of the bisection at which it stops."""

Array = NDArray[np.float64]
Triangles = tuple[Array, NDArray[np.int64]]


def sampled(mesh: Triangles, count: int, seed: int) -> tuple[Array, Array]:
    """Return points of a mesh, uniform by area, and the normals of their faces."""
    random = np.random.default_rng(seed)
    corners = mesh[0][mesh[1]]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(across, axis=1)
    faces = random.choice(len(areas), count, p=areas / areas.sum())
    u, v = np.sqrt(random.random(count)), random.random(count)
    weights = np.stack([1 - u, u * (1 - v), u * v], axis=1)
    return np.einsum("pi,pic->pc", weights, corners[faces]), across[faces] / areas[faces, None]


def distances(points: Array, mesh: Triangles) -> Array:
    """Return the exact distance of each point from a mesh."""
    return np.sqrt(np.maximum(igl.point_mesh_squared_distance(points, mesh[0], mesh[1])[0], 0))


@dataclass(frozen=True)
class Model:
    """A true surface, and points of it."""

    name: str
    truth: Triangles

    @classmethod
    def read(cls, path: Path) -> Model:
        """Read a mesh, equal vertices merged."""
        mesh = trimesh.load(path, process=False)
        vertices, rows = np.unique(np.asarray(mesh.vertices, float), axis=0, return_inverse=True)
        return cls(path.stem, (vertices, rows.reshape(-1)[np.asarray(mesh.faces)]))

    @cached_property
    def cloud(self) -> tuple[Array, Array]:
        """The points and their normals."""
        return sampled(self.truth, POINTS, zlib.crc32(self.name.encode()))

    @cached_property
    def diagonal(self) -> float:
        """That of the points' bounding box."""
        return float(np.linalg.norm(np.ptp(self.cloud[0], axis=0)))

    @cached_property
    def rival(self) -> Triangles:
        """The mesh that Poisson makes, before any collapse."""
        return poisson(Cloud(*self.cloud, self.name, "samples"), PoissonOptions())

    def rms(self, mesh: Triangles) -> float:
        """Return the larger root mean square distance, of the truth from a mesh and of the mesh from the truth."""
        to_mesh = distances(sampled(self.truth, SAMPLES, 1)[0], mesh)
        to_truth = distances(sampled(mesh, SAMPLES, 2)[0], self.truth)
        return float(max(np.sqrt(np.mean(to_mesh**2)), np.sqrt(np.mean(to_truth**2))))

    def farthest(self, mesh: Triangles, dropped: Array) -> tuple[float, float]:
        """Return how far a point is from a mesh, and a place of the mesh from its points' planes, at most.

        Points that were dropped as strays do not count.
        """
        kept = ~(self.cloud[0][:, None] == dropped[None]).all(axis=2).any(axis=1)
        points, normals = (each[kept] for each in self.cloud)
        places = np.vstack([mesh[0], sampled(mesh, SAMPLES, 3)[0]])
        nearest = cKDTree(points).query(places, NEAREST)[1]
        heights = np.einsum("pkc,pkc->pk", places[:, None] - points[nearest], normals[nearest])
        return float(distances(points, mesh).max()), float(np.abs(heights).min(axis=1).max())

    def rival_triangles(self, rms: float) -> int | None:
        """Return how many triangles of the rival reach a root mean square distance; None if all do not."""
        if self.rms(self.rival) > rms:
            return None
        low, high = 6, len(self.rival[0])
        triangles = len(self.rival[1])
        while high > CLOSE * low + 1:
            vertices = round((low * high) ** 0.5)
            made = reduced(self.rival, vertices, "fast")
            if self.rms(made) <= rms:
                high, triangles = vertices, len(made[1])
            else:
                low = vertices
        return triangles


def line_of(model: Model, percent: float) -> str:
    """Reconstruct a model to an error; return its row of the table."""
    made = reconstruct(*model.cloud, error=f"{percent}%")
    mesh, error = (made.vertices, made.faces), percent / 100 * model.diagonal
    point, place = model.farthest(mesh, made.dropped.points)
    rms = model.rms(mesh)
    rival = model.rival_triangles(rms)
    kept = "yes" if max(point, place) <= error * (1 + 1e-6) else "no"
    told = "" if not made.report.missed else "told"
    shares = " | ".join(f"{value / error:.2f}" for value in (point, place, rms))
    return f"| {model.name} | {percent:g} | {kept} | {told} | {shares} | {len(mesh[1])} | {rival or 'never'} |"


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path))
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option("--errors", default="2,1,0.5", show_default=True, help="in percent of the diagonal")
def main(folder: Path, meshes: str | None, errors: str) -> None:
    """Print the table of the meshes of FOLDER as Markdown."""
    click.echo("| mesh | error, % | kept | exit 5 | points | places | rms | triangles | Poisson + collapse |")
    click.echo("|---|---|---|---|---|---|---|---|---|")
    for path in sorted(path for path in folder.glob("*.ply") if not meshes or path.stem in meshes.split(",")):
        model = Model.read(path)
        for percent in map(float, errors.split(",")):
            click.echo(line_of(model, percent))


if __name__ == "__main__":
    main()
