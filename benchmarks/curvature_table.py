# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy of the estimated curvature tensors, by every method; prints the tables of docs/curvature.md.

    python benchmarks/curvature_table.py [--surfaces cylinder,torus] [--noise 0,0.1%] [--meshes bull,trex]
        [--weights best.safetensors]

Points are drawn evenly by area of analytic surfaces, and of the meshes of a folder, whose curvature the ground truth of
`hdpea.dataset` fits to the normals of the mesh itself. Methods get the points alone, with Gaussian noise in shares of
the diagonal of the bounding box. Every embedding that hdpea has is a row, and so are jets.

A mesh has facets, often larger than the radius in which curvature is fitted; there its curvature depends on where
exactly it is measured. The row `mesh` shows how much: it fits, at the same length, the mesh's own normals at the points
themselves, instead of at vertices between which the truth is interpolated. Meshes have rows for all points, and for
those that are certain, where these two fits of the mesh agree on the direction to 10 degrees.

Directions are compared where the true stretching ratio is over 1.5 and the method calls them determined. The true
ratio is that of the metric, sqrt(clamp(c |k1|) / clamp(c |k2|)); inside the range of the metric nothing is clamped.
Times are processor times of all threads together, which depend less on the load of the machine.
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
from analytic import SURFACES, Samples, samples_of
from val_table import POINTS, ROOT, read_mesh

from hdpea import CurvatureOptions, CurvatureTensors, _core, estimate_curvature
from hdpea.curvature.from_embedding import LEAST_RATIO
from hdpea.curvature.options import EstimationOptions
from hdpea.dataset.ground_truth import embed_mesh
from hdpea.dataset.options import GroundTruthOptions
from hdpea.embedding import EMBEDDERS
from hdpea.errors import HdpeaError
from hdpea.geometry.metric import Metric
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.tensors import metric_tensors
from hdpea.geometry.triangles import mesh_area
from hdpea.options import CleaningOptions, EmbeddingOptions, NormalOptions
from hdpea.surface.surface import NEIGHBORS

JET, LEARNED, MESH = "jet", "learned", "mesh"
CLEAR_RATIO = 1.5
SURE_DEGREES = 10
HEADER = (
    "cloud", "noise", "method", "determined, %", "direction, degrees", "ratio, %", "in range, %", "k1, %", "seconds",
)  # fmt: skip


@dataclass(frozen=True)
class Errors:
    """Errors at the points of a cloud (or of several): each (m,), of those points that the name says."""

    determined: np.ndarray
    direction: np.ndarray
    ratio: np.ndarray
    ratio_in_range: np.ndarray
    curvature: np.ndarray
    seconds: float


@dataclass(frozen=True)
class Cloud:
    """Points of a surface and the truth there; of a mesh also a second fit to it, by which some of them are `sure`."""

    truth: Samples
    mesh: CurvatureTensors | None = None
    sure: np.ndarray | None = None


def options_of(method: str, weights: str | None) -> CurvatureOptions:
    """Return the defaults of a method: an embedding by its name, or jets; but with the quickest orientation.

    Which side is out changes signs, which are not compared, and finding it by winding number takes most of the time.
    All points are kept, as each is compared with its own truth.
    """
    normals, cleaning = NormalOptions(orient="mst"), CleaningOptions(outliers="none")
    if method == JET:
        return CurvatureOptions(EstimationOptions(method=JET), normals, cleaning=cleaning)
    embedding = EmbeddingOptions(embedding=method, weights=weights if method == LEARNED else None)
    return CurvatureOptions(normals=normals, embedding=embedding, cleaning=cleaning)


def metric_of(tensors: CurvatureTensors) -> Metric:
    """Return the metric in world units: that of the embedding, or for jets that of the options."""
    low, high = tensors.curvature_range
    if np.isfinite(high):
        return Metric(1 / low, (high / low) ** 0.5)
    options = EmbeddingOptions()
    diagonal = float(np.linalg.norm(np.ptp(tensors.points, axis=0)))
    return Metric(options.metric_scale * diagonal, options.max_stretch)


def estimate(cloud: Cloud, noise: float, method: str, seed: int, weights: str | None) -> tuple[CurvatureTensors, float]:
    """Estimate the curvature of a noisy cloud; return it, and the seconds it took."""
    if method == MESH and cloud.mesh:
        return cloud.mesh, 0.0
    points = cloud.truth.points
    deviation = noise * np.linalg.norm(np.ptp(points, axis=0))
    noisy = points + np.random.default_rng(seed).normal(0, deviation, points.shape)
    start = time.process_time()
    tensors = estimate_curvature(noisy, options=options_of(method, weights))
    return tensors, time.process_time() - start


def degrees_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the angles (n,) of lines (n, 3), which have no sign."""
    return np.degrees(np.arccos(abs(np.einsum("nc,nc->n", a, b)).clip(0, 1)))


def errors_of(truth: Samples, tensors: CurvatureTensors, seconds: float, looked_at: np.ndarray | None) -> Errors:
    """Compare an estimate with the truth, at the points `looked_at` (n,) bool."""
    metric, magnitudes = metric_of(tensors), abs(truth.curvatures)
    stretches = metric.stretches(truth.curvatures)
    ratio = stretches[:, 0] / stretches[:, 1]
    looked_at = np.ones(len(ratio), dtype=bool) if looked_at is None else looked_at
    clear, known = looked_at & (ratio > CLEAR_RATIO), looked_at & np.isfinite(tensors.stretching_ratio)
    low, high = metric.curvature_range
    in_range = known & (magnitudes > low).all(axis=1) & (magnitudes < high).all(axis=1)
    bent = known & (magnitudes[:, 0] > low) & (magnitudes[:, 0] < high)
    with np.errstate(divide="ignore", invalid="ignore"):
        off_ratio = 100 * abs(tensors.stretching_ratio / ratio - 1)
        off_curvature = 100 * abs(abs(tensors.curvatures[:, 0]) / magnitudes[:, 0] - 1)
    return Errors(
        100.0 * tensors.determined[clear],
        degrees_between(tensors.direction1, truth.direction1)[clear & tensors.determined],
        off_ratio[bent],
        off_ratio[in_range],
        off_curvature[bent],
        seconds,
    )


def print_row(cloud: str, noise: float, method: str, errors: Sequence[Errors]) -> None:
    """Print the errors at all points of these clouds together: median and 90 % of the points, and the mean seconds."""

    def spread(name: str) -> str:
        values = np.concatenate([getattr(each, name) for each in errors])
        return "{:.1f} / {:.1f}".format(*np.percentile(values, [50, 90])) if len(values) else ""

    determined = np.concatenate([each.determined for each in errors])
    row = [cloud, f"{noise:.1%}" if noise else "clean", method, f"{determined.mean():.0f}" if len(determined) else ""]
    row += [spread(name) for name in ("direction", "ratio", "ratio_in_range", "curvature")]
    row.append(f"{np.mean([each.seconds for each in errors]):.1f}")
    click.echo(f"| {' | '.join(row)} |")


def print_rows(
    name: str, clouds: Sequence[Cloud], noises: Sequence[float], methods: Sequence[str], weights: str | None
) -> None:
    """Print a row for each noise and method, of these clouds together; of their sure points another."""
    for noise in noises:
        for method in methods:
            try:
                found = [estimate(cloud, noise, method, seed, weights) for seed, cloud in enumerate(clouds)]
            except HdpeaError as error:
                click.echo(f"| {name} | {noise:.1%} | {method} | {error.message} |")
                continue
            pairs = list(zip(clouds, found, strict=True))
            print_row(name, noise, method, [errors_of(cloud.truth, *each, None) for cloud, each in pairs])
            if all(cloud.sure is not None for cloud in clouds):
                sure = [errors_of(cloud.truth, *each, cloud.sure) for cloud, each in pairs]
                print_row(f"{name}, sure points", noise, method, sure)


def cloud_of_mesh(path: Path, count: int) -> Cloud:
    """Draw points of a mesh, with its own curvature there."""
    vertices, faces = read_mesh(path)
    embedded = embed_mesh(vertices, faces)
    seed = zlib.crc32(path.stem.encode()) % 100_000
    drawn = sample_surface(vertices, faces, count, seed=seed)
    points = embedded.frame.to_unit(drawn.points)
    here = embedded.at(points)
    area = mesh_area(embedded.frame.to_unit(vertices), faces)
    again = fit_of_mesh(points, drawn.normals, area)
    sure = degrees_between(again.direction1, here.direction1) < SURE_DEGREES
    return Cloud(Samples(points, here.curvatures, here.direction1), again, sure)


def fit_of_mesh(points: np.ndarray, normals: np.ndarray, area: float) -> CurvatureTensors:
    """Fit curvature to true normals at the points (n, 3) themselves, at the length that the truth has."""
    truth, chosen = GroundTruthOptions(), EmbeddingOptions()
    neighbors = _core.sheet_neighbors(points, normals, _core.nearest_neighbors(points, NEIGHBORS))
    fitted = _core.estimate_curvature(
        points, normals, neighbors, truth.curvature_radius * (area / truth.vertices) ** 0.5
    )
    metric = Metric(chosen.metric_scale * float(np.linalg.norm(np.ptp(points, axis=0))), chosen.max_stretch)
    stretches = metric.stretches(fitted.principal)
    return CurvatureTensors(
        points,
        normals,
        fitted.direction1,
        np.cross(normals, fitted.direction1),
        stretches,
        fitted.principal,
        metric_tensors(normals, fitted.direction1, stretches),
        stretches[:, 0] >= LEAST_RATIO * stretches[:, 1],
        np.arange(len(points)),
        signed=True,
        curvature_range=metric.curvature_range,
    )


def listed(text: str) -> list[str]:
    """Split ``a,b``."""
    return [each for each in text.split(",") if each]


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.option("--points", default=POINTS, show_default=True)
@click.option("--surfaces", default=",".join(SURFACES), show_default=True, help="analytic surfaces; empty: none")
@click.option("--meshes", help="only these of the folder, by name: bull,trex; empty: none")
@click.option("--noise", default="0,0.1%,0.3%", show_default=True, help="standard deviations, of the diagonal")
@click.option("--methods", default=",".join([*EMBEDDERS, JET]), show_default=True)
@click.option("--weights", help="of the learned embedding, instead of those that come along")
def main(
    *,
    folder: Path,
    points: int,
    surfaces: str,
    meshes: str | None,
    noise: str,
    methods: str,
    weights: str | None,
) -> None:
    """Print the errors on analytic surfaces, and on the meshes of FOLDER: median / 90 % of the points."""
    noises = [float(each.rstrip("%")) / (100 if each.endswith("%") else 1) for each in listed(noise)]
    wanted = listed(methods)
    click.echo(f"| {' | '.join(HEADER)} |")
    click.echo("|---" * len(HEADER) + "|")
    for name in listed(surfaces):
        print_rows(name, [Cloud(samples_of(SURFACES[name], points))], noises, wanted, weights)
    paths = [path for path in sorted(folder.glob("*.ply")) if meshes is None or path.stem in listed(meshes)]
    if paths:
        clouds = [cloud_of_mesh(path, points) for path in paths]
        print_rows(f"{len(paths)} meshes", clouds, noises, [MESH, *wanted], weights)


if __name__ == "__main__":
    main()
