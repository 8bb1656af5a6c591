# SPDX-License-Identifier: GPL-3.0-or-later
"""How well normals are estimated and oriented, by every way of orienting them.

    python benchmarks/orientation_table.py [--meshes bull,trex]

Each mesh of a folder is sampled as `val_table.py` does, and scanned by a simulated sensor; normals are estimated from
the points, oriented, and compared with the true ones. Also times every way on scans as they come from scanners, whose
true normals nobody knows.
Prints Markdown. Needs the `bench` dependency group and embreex (`make bench-setup` has both).
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray
from val_table import POINTS, ROOT, load_metrics, read_mesh

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.scanning import scan_surface
from hdpea.dataset.surface_file import read_surface
from hdpea.frame import UnitFrame
from hdpea.normals import oriented_surface
from hdpea.options import NormalOptions
from hdpea.position import Position
from hdpea.reading import read_points

Array = NDArray[np.float64]

NOISE = 0.003
"""Standard deviation of the noise, in bounding-box diagonals; in scans that of the range."""

VIEWS = 6
"""Places from which a mesh is scanned: few, and all above it, so that there are holes."""

WAYS = ("auto", "wnnc", "mst", "viewpoint")


@dataclass(frozen=True)
class Cloud:
    """Points and their true normals, and from where each was seen, if anybody looked."""

    points: Array
    normals: Array
    sensors: Array | None = None


@dataclass(frozen=True)
class Score:
    """What came of one cloud: share of normals within 90 degrees of the truth, mean angle to it, time."""

    right: float
    degrees: float
    seconds: float


def noisy(cloud: Cloud, seed: int) -> Cloud:
    """Return the cloud with Gaussian noise on its points."""
    deviation = NOISE * np.linalg.norm(np.ptp(cloud.points, axis=0))
    noise = np.random.default_rng(seed).normal(0, deviation, cloud.points.shape)
    return Cloud(cloud.points + noise, cloud.normals, cloud.sensors)


def scanned(path: Path, noise: float, seed: int) -> Cloud:
    """Return what a sensor sees of a mesh on a turntable; what it does not see is a hole."""
    vertices, faces = read_surface(path)
    frame = UnitFrame.around(vertices)
    options = ScanOptions(points=POINTS, sensor="turntable", views=VIEWS, noise=noise, seed=seed)
    scan = scan_surface(frame.to_unit(vertices), faces, options)
    return Cloud(frame.to_world(scan.points), scan.normals, frame.to_world(scan.sensors))


def score(cloud: Cloud, way: str) -> Score:
    """Estimate and orient the normals of a cloud, and compare them with the truth."""
    start = time.perf_counter()
    surface = oriented_surface(cloud.points, None, NormalOptions(orient=way), sensors_in_world=cloud.sensors).surface
    seconds = time.perf_counter() - start
    cosines = np.einsum("nc,nc->n", surface.normals, cloud.normals)
    degrees = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return Score(100 * float((cosines > 0).mean()), float(degrees.mean()), seconds)


def print_rows(condition: str, clouds: dict[str, Cloud]) -> None:
    """Print a row for each way of orienting these clouds."""
    for way in WAYS:
        if way == "viewpoint" and any(cloud.sensors is None for cloud in clouds.values()):
            continue
        scores = {name: score(cloud, way) for name, cloud in clouds.items()}
        worst = min(scores, key=lambda name: scores[name].right)
        right = np.mean([each.right for each in scores.values()])
        degrees = np.mean([each.degrees for each in scores.values()])
        seconds = np.mean([each.seconds for each in scores.values()])
        row = [
            condition,
            way,
            f"{right:.2f}",
            f"{scores[worst].right:.2f} ({worst})",
            f"{degrees:.1f}",
            f"{seconds:.1f}",
        ]
        click.echo(f"| {' | '.join(row)} |")


def print_scans(folder: Path) -> None:
    """Print how long each way takes on real scans; a viewpoint far above them stands for the sensor."""
    click.echo("\n| scan | points | " + " | ".join(f"{way}, s" for way in WAYS) + " |")
    click.echo("|---" * (2 + len(WAYS)) + "|")
    for name in ("bunny_range_scans", "dining_room_fragment"):
        points = read_points(folder / f"{name}.ply").points
        above = Position(*(points.max(axis=0) + 10 * np.ptp(points, axis=0)).tolist())
        times = []
        for way in WAYS:
            options = NormalOptions(normals="estimate", orient=way, viewpoint=above if way == "viewpoint" else None)
            start = time.perf_counter()
            oriented_surface(points, None, options)
            times.append(f"{time.perf_counter() - start:.1f}")
        click.echo(f"| {name} | {len(points):,} | {' | '.join(times)} |")


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.argument("scans", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/clouds")
@click.option("--meshes", help="only these, by name: bull,trex")
def main(*, folder: Path, baselines: Path, scans: Path, meshes: str | None) -> None:
    """Orient the samples of the meshes of FOLDER; time the SCANS."""
    paths = sorted(path for path in folder.glob("*.ply") if not meshes or path.stem in meshes.split(","))
    if not paths:
        raise click.UsageError(f"no such meshes in {folder}")
    metrics = load_metrics(baselines)
    clean, seeds = {}, {path.stem: zlib.crc32(path.stem.encode()) % 100_000 for path in paths}
    for path in paths:
        truth = metrics.GroundTruth(*read_mesh(path), seed=seeds[path.stem])
        clean[path.stem] = Cloud(*metrics.sample(truth.V, truth.F, POINTS, seeds[path.stem]))
    conditions: dict[str, Callable[[str], Cloud]] = {
        "clean": lambda name: clean[name],
        f"{NOISE:.1%} noise": lambda name: noisy(clean[name], seeds[name]),
        "scan with holes": lambda name: scanned(folder / f"{name}.ply", 0, seeds[name]),
        f"the same, {NOISE:.1%} noise": lambda name: scanned(folder / f"{name}.ply", NOISE, seeds[name]),
    }
    click.echo("| cloud | --orient | within 90 degrees, % | worst mesh, % | mean error, degrees | seconds |")
    click.echo("|---|---|---|---|---|---|")
    for condition, made in conditions.items():
        print_rows(condition, {name: made(name) for name in clean})
    print_scans(scans)


if __name__ == "__main__":
    main()
