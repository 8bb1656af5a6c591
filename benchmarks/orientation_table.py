# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy of estimated normals and of their orientation, by every method of orientation.

    python benchmarks/orientation_table.py [--meshes bull,trex] [--noise 0.005] [--save DIR]
    python benchmarks/orientation_table.py --only-clouds --cloud FILE --picture DIR

Each mesh of a folder is sampled as `val_table.py` does, and scanned by a simulated sensor; normals are estimated from
the points, oriented, and compared with the true ones. Also times every method on raw scans, whose true
normals are unknown: look at the pictures.
Prints Markdown. Needs the `bench` dependency group and embreex (`make bench-setup` has both).
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import ModuleType

import click
import numpy as np
from keeping import kept
from numpy.typing import NDArray
from val_table import POINTS, ROOT, Sampled, load_metrics, meshes_of

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.sample_picture import PANEL
from hdpea.dataset.scanning import scan_surface
from hdpea.dataset.surface_file import read_surface
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import NormalOptions
from hdpea.options.position import Position
from hdpea.pictures.camera import choose_view_of_points
from hdpea.pictures.picture import DOTS, FRONT, drawn_to, look_at, point_size
from hdpea.reading import read_points
from hdpea.reading.cleaning import cleaned
from hdpea.surface.normals import oriented_surface

Array = NDArray[np.float64]

VIEWS = 6
"""Views from which a mesh is scanned: few, and all from above, so that there are holes."""

METHODS = ("auto", "wnnc", "mst", "viewpoint")

Score = tuple[float, float, float]
"""Score of one cloud: percent of the normals within 90 degrees of the truth, mean angle to it, seconds."""


@dataclass(frozen=True)
class Cloud:
    """Points and their true normals, and the position of the sensor of each, if there was one."""

    points: Array
    normals: Array
    sensors: Array | None = None


def noisy(cloud: Cloud, noise: float, seed: int) -> Cloud:
    """Return the cloud with Gaussian noise on its points, in shares of its diagonal."""
    deviation = noise * np.linalg.norm(np.ptp(cloud.points, axis=0))
    moves = np.random.default_rng(seed).normal(0, deviation, cloud.points.shape)
    return Cloud(cloud.points + moves, cloud.normals, cloud.sensors)


def scanned(path: Path, noise: float, seed: int) -> Cloud:
    """Scan a mesh on a turntable; parts that the sensor does not see are holes."""
    vertices, faces = read_surface(path)
    frame = UnitFrame.around(vertices)
    options = ScanOptions(points=POINTS, sensor="turntable", views=VIEWS, noise=noise, seed=seed)
    scan = scan_surface(frame.to_unit(vertices), faces, options)
    return Cloud(frame.to_world(scan.points), scan.normals, frame.to_world(scan.sensors))


def score(cloud: Cloud, method: str) -> Score:
    """Estimate and orient the normals of a cloud, and compare them with the truth."""
    start = time.perf_counter()
    surface = oriented_surface(cloud.points, None, NormalOptions(orient=method), sensors_in_world=cloud.sensors).surface
    seconds = time.perf_counter() - start
    cosines = np.einsum("nc,nc->n", surface.normals, cloud.normals)
    degrees = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return 100 * float((cosines > 0).mean()), float(degrees.mean()), seconds


def methods_of(cloud: Cloud) -> tuple[str, ...]:
    """Return the methods by which a cloud can be oriented: towards the sensors only if there were any."""
    return tuple(method for method in METHODS if method != "viewpoint" or cloud.sensors is not None)


def run_mesh(path: Path, metrics: ModuleType, noise: float) -> dict[str, dict[str, Score]]:
    """Return the scores of every method on every kind of cloud made from a mesh."""
    sampled = Sampled.of(path, metrics)
    clean = Cloud(sampled.points, sampled.normals)
    clouds = {
        "clean": clean,
        f"{noise:.1%} noise": noisy(clean, noise, sampled.seed),
        "scan with holes": scanned(path, 0, sampled.seed),
        f"the same, {noise:.1%} noise": scanned(path, noise, sampled.seed),
    }
    click.echo(path.stem, err=True)
    return {kind: {method: score(cloud, method) for method in methods_of(cloud)} for kind, cloud in clouds.items()}


def print_meshes(paths: list[Path], baselines: Path, noise: float, save: Path | None) -> None:
    """Print the scores of each method on every kind of cloud made from the meshes."""
    metrics = load_metrics(baselines)
    by_mesh = {
        path.stem: kept(save, f"{path.stem}-{noise:g}", partial(run_mesh, path, metrics, noise)) for path in paths
    }
    click.echo("| cloud | --orient | within 90 degrees, % | worst mesh, % | mean error, degrees | seconds |")
    click.echo("|---|---|---|---|---|---|")
    for kind, of_kind in by_mesh[paths[0].stem].items():
        for method in of_kind:
            scores = {name: kinds[kind][method] for name, kinds in by_mesh.items()}
            worst, (least, *_) = min(scores.items(), key=lambda item: item[1][0])
            right, degrees, seconds = np.mean(list(scores.values()), axis=0)
            row = [kind, method, f"{right:.2f}", f"{least:.2f} ({worst})", f"{degrees:.1f}", f"{seconds:.1f}"]
            click.echo(f"| {' | '.join(row)} |")


def print_clouds(paths: list[Path], pictures: Path | None) -> None:
    """Print how long each method takes on raw clouds; a viewpoint far above them represents the sensor."""
    click.echo("\n| cloud | points | " + " | ".join(f"{method}, s" for method in METHODS) + " |")
    click.echo("|---" * (2 + len(METHODS)) + "|")
    for path in paths:
        points = cleaned(read_points(path)).points
        above = Position(*(points.max(axis=0) + 10 * np.ptp(points, axis=0)).tolist())
        times, normals = [], {}
        for method in METHODS:
            options = NormalOptions(
                normals="estimate", orient=method, viewpoint=above if method == "viewpoint" else None
            )
            start = time.perf_counter()
            normals[method] = oriented_surface(points, None, options).surface.normals
            times.append(f"{time.perf_counter() - start:.1f}")
        click.echo(f"| {path.stem} | {len(points):,} | {' | '.join(times)} |")
        if pictures is not None:
            draw_sides(pictures / f"{path.stem}.png", points, normals)


def draw_sides(path: Path, points: Array, normals: dict[str, Array]) -> None:
    """Draw a panel for each method: points facing the viewer in one colour, those facing away in another."""
    view_from_world = choose_view_of_points(points, normals["auto"])
    in_view = UnitFrame.around(points).to_unit(points) @ view_from_world.T
    # Spheres, which hide what is behind them.
    size = point_size(len(points) // 2, PANEL)
    window = [PANEL[0] * len(normals), PANEL[1]]
    with drawn_to(path, shape=(1, len(normals)), window_size=window) as (_, plotter):
        for column, (method, of_method) in enumerate(normals.items()):
            plotter.subplot(0, column)
            facing = (of_method @ view_from_world.T)[:, 2] > 0
            for side, color in ((facing, FRONT), (~facing, DOTS)):
                if side.any():
                    plotter.add_points(in_view[side], color=color, point_size=size, render_points_as_spheres=True)
            plotter.add_text(method, font_size=12, color="black")
            look_at(plotter, in_view, PANEL)


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option(
    "--noise", default=0.003, show_default=True, help="in bounding-box diagonals; for scans, noise of the range"
)
@click.option("--cloud", "clouds", multiple=True, type=click.Path(exists=True, path_type=Path), help="a raw cloud")
@click.option("--picture", "pictures", type=click.Path(path_type=Path), help="folder for a picture of each raw cloud")
@click.option("--only-clouds", is_flag=True, help="leave out the meshes")
@click.option("--save", type=click.Path(path_type=Path), help="folder of stored scores, which are not computed again")
def main(
    *,
    folder: Path,
    baselines: Path,
    meshes: str | None,
    noise: float,
    clouds: tuple[Path, ...],
    pictures: Path | None,
    only_clouds: bool,
    save: Path | None,
) -> None:
    """Orient the samples of the meshes of FOLDER, and raw clouds."""
    if not only_clouds:
        print_meshes(meshes_of(folder, meshes), baselines, noise, save)
    if pictures is not None:
        pictures.mkdir(parents=True, exist_ok=True)
    if clouds:
        print_clouds(list(clouds), pictures)


if __name__ == "__main__":
    main()
