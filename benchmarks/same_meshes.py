# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a change keeps every mesh: ten clouds, both embeddings, before and after.

    python benchmarks/same_meshes.py record before.npz       # with the package as it was
    python benchmarks/same_meshes.py record after.npz        # with the package as it is
    python benchmarks/same_meshes.py compare before.npz after.npz

The same means the same faces, and vertices within 1e-12 of the diagonal; anything else ends with exit code 1.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hdpea import reconstruct
from hdpea.options import EmbeddingOptions, MeshingOptions, Options

Array = NDArray[np.float64]
Cloud = tuple[Array, Array | None]

TOLERANCE = 1e-12
"""Of the vertices, in diagonals."""

EMBEDDINGS = ("direct", "learned")


def sphere(count: int) -> Cloud:
    """Return random points of the unit sphere and their normals."""
    directions = np.random.default_rng(0).normal(size=(count, 3))
    normals = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    return normals, normals


def torus(count: int) -> Cloud:
    """Return points of a torus of radii 1 and 0.3, dense on its inside, and their normals."""
    u, v = np.random.default_rng(1).uniform(0, 2 * np.pi, (2, count))
    normals = np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], axis=1)
    ring = np.stack([np.cos(u), np.sin(u), np.zeros(count)], axis=1)
    return ring + 0.3 * normals, normals


def box(count: int, size: tuple[float, float, float]) -> Cloud:
    """Return points of a box by area, and their normals."""
    random = np.random.default_rng(2)
    sides = np.array([size[1] * size[2], size[0] * size[2], size[0] * size[1]])
    axis, sign = random.choice(3, count, p=sides / sides.sum()), random.choice([-0.5, 0.5], count)
    points = random.uniform(-0.5, 0.5, (count, 3))
    points[np.arange(count), axis] = sign
    return points * size, 2 * sign[:, None] * np.eye(3)[axis]


def _noisy(count: int) -> Cloud:
    points, _ = torus(count)
    return points + np.random.default_rng(3).normal(0, 0.01, points.shape), None


def _open(count: int) -> Cloud:
    points, normals = sphere(count)
    kept = points[:, 2] > -0.3
    return points[kept], None if normals is None else normals[kept]


def _flipped(count: int) -> Cloud:
    points, normals = torus(count)
    return points, normals * np.random.default_rng(4).choice([-1.0, 1.0], (count, 1))


def _two_pieces(count: int) -> Cloud:
    (ball, up), (plate, sides) = sphere(count // 2), box(count // 2, (2, 1, 0.2))
    return np.vstack([ball, plate + np.array([3, 0, 0])]), np.vstack([up, sides])


CLOUDS: dict[str, tuple[Callable[[], Cloud], MeshingOptions]] = {
    "sphere": (lambda: sphere(4_000), MeshingOptions()),
    "sphere without normals": (lambda: (sphere(4_000)[0], None), MeshingOptions()),
    "torus": (lambda: torus(6_000), MeshingOptions()),
    "torus, few vertices": (lambda: torus(6_000), MeshingOptions(vertices=150)),
    "torus, normals on both sides": (lambda: _flipped(5_000), MeshingOptions()),
    "torus with noise": (lambda: _noisy(5_000), MeshingOptions()),
    "box far from the origin": (lambda: (box(6_000, (3, 2, 1))[0] + 1e6, None), MeshingOptions(faces=1_500)),
    "plate with thin sides": (lambda: box(6_000, (3, 2, 0.05)), MeshingOptions()),
    "open sphere, made watertight": (lambda: _open(5_000), MeshingOptions(watertight=True)),
    "two pieces": (lambda: _two_pieces(6_000), MeshingOptions(vertices=700)),
}


@click.group()
def main() -> None:
    """Compare the meshes of two versions of hdpea."""


@main.command()
@click.argument("out", type=click.Path(path_type=Path))
def record(out: Path) -> None:
    """Write the meshes of the hdpea that is imported to OUT (NPZ)."""
    arrays: dict[str, NDArray[np.float64 | np.int64]] = {}
    for name, (cloud, meshing) in CLOUDS.items():
        points, normals = cloud()
        for embedding in EMBEDDINGS:
            options = Options(meshing=meshing, embedding=EmbeddingOptions(embedding=embedding))
            mesh = reconstruct(points, normals, options=options)
            key = f"{name}, {embedding}"
            arrays[f"{key}/vertices"], arrays[f"{key}/faces"] = mesh.vertices, mesh.faces
            arrays[f"{key}/diagonal"] = np.linalg.norm(np.ptp(points, axis=0))
            print(f"{key}: {len(mesh.vertices):,} vertices, {len(mesh.faces):,} faces")
    np.savez_compressed(out, **arrays)


@main.command()
@click.argument("before", type=click.Path(exists=True, path_type=Path))
@click.argument("after", type=click.Path(exists=True, path_type=Path))
def compare(before: Path, after: Path) -> None:
    """List what differs between two recordings."""
    differences = list(_differences(dict(np.load(before)), dict(np.load(after))))
    print("| cloud | same faces | largest move of a vertex, diagonals |\n| --- | --- | --- |")
    for key, same_faces, move in differences:
        print(f"| {key} | {'yes' if same_faces else 'NO'} | {move:.1e} |")
    sys.exit(not all(same and move <= TOLERANCE for _, same, move in differences))


def _differences(before: dict[str, Array], after: dict[str, Array]) -> Iterator[tuple[str, bool, float]]:
    for key in (name.removesuffix("/faces") for name in before if name.endswith("/faces")):
        old, new = before[f"{key}/vertices"], after[f"{key}/vertices"]
        same_faces = np.array_equal(before[f"{key}/faces"], after[f"{key}/faces"])
        move = np.linalg.norm(old - new, axis=1).max() if old.shape == new.shape else np.inf
        yield key, same_faces, float(move / before[f"{key}/diagonal"])


if __name__ == "__main__":
    main()
