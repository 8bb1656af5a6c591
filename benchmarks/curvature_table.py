# SPDX-License-Identifier: GPL-3.0-or-later
"""How true the estimated curvature tensors are, by every method; prints the tables of docs/curvature.md.

    python benchmarks/curvature_table.py [--surfaces cylinder,torus] [--noise 0,0.1%] [--meshes bull,trex]

Points are drawn evenly by area of analytic surfaces, and of the meshes of a folder, whose curvature the ground truth of
`hdpea.dataset` fits to the normals of the mesh itself. Methods get the points alone, with Gaussian noise in shares of
the diagonal of the bounding box. Every embedding that hdpea has is a row, and so are jets.

Directions are compared where the true stretching ratio is over 1.5 and the method calls them determined. The true
ratio is that of the metric, sqrt(clamp(c |k1|) / clamp(c |k2|)); inside the range of the metric nothing is clamped.
Times are of the processor, all threads together, since a busy machine makes any wall clock wrong.
"""

from __future__ import annotations

import time
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
from analytic import SURFACES, Samples, samples_of
from val_table import POINTS, ROOT, read_mesh

from hdpea import CurvatureOptions, CurvatureTensors, estimate_curvature
from hdpea.curvature.options import EstimationOptions
from hdpea.dataset.ground_truth import embed_mesh
from hdpea.dataset.options import SamplingOptions
from hdpea.dataset.sampling import sample_surface
from hdpea.embedding import EMBEDDERS
from hdpea.embedding.embedded import Metric
from hdpea.errors import HdpeaError
from hdpea.options import EmbeddingOptions, NormalOptions

JET = "jet"
CLEAR_RATIO = 1.5
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


def options_of(method: str) -> CurvatureOptions:
    """Return the defaults of a method: an embedding by its name, or jets; but with the quickest orientation.

    Which side is out changes signs, which are not compared, and finding it by winding number takes most of the time.
    """
    normals = NormalOptions(orient="mst")
    if method == JET:
        return CurvatureOptions(EstimationOptions(method=JET), normals)
    return CurvatureOptions(normals=normals, embedding=EmbeddingOptions(embedding=method))


def metric_of(tensors: CurvatureTensors) -> Metric:
    """Return the metric in world units: that of the embedding, or for jets that of the options."""
    low, high = tensors.curvature_range
    if np.isfinite(high):
        return Metric(1 / low, (high / low) ** 0.5)
    options = EmbeddingOptions()
    diagonal = float(np.linalg.norm(np.ptp(tensors.points, axis=0)))
    return Metric(options.metric_scale * diagonal, options.max_stretch)


def errors_of(truth: Samples, noise: float, method: str, seed: int) -> Errors:
    """Estimate the curvature of a noisy cloud, and compare it with the truth."""
    deviation = noise * np.linalg.norm(np.ptp(truth.points, axis=0))
    points = truth.points + np.random.default_rng(seed).normal(0, deviation, truth.points.shape)
    start = time.process_time()
    tensors = estimate_curvature(points, options=options_of(method))
    seconds = time.process_time() - start
    metric, magnitudes = metric_of(tensors), abs(truth.curvatures)
    stretches = metric.stretches(truth.curvatures)
    ratio = stretches[:, 0] / stretches[:, 1]
    cosines = abs(np.einsum("nc,nc->n", tensors.direction1, truth.direction1)).clip(0, 1)
    clear, known = ratio > CLEAR_RATIO, np.isfinite(tensors.stretching_ratio)
    low, high = metric.curvature_range
    in_range = known & (magnitudes > low).all(axis=1) & (magnitudes < high).all(axis=1)
    bent = known & (magnitudes[:, 0] > low) & (magnitudes[:, 0] < high)
    with np.errstate(divide="ignore", invalid="ignore"):
        off_ratio = 100 * abs(tensors.stretching_ratio / ratio - 1)
        off_curvature = 100 * abs(abs(tensors.curvatures[:, 0]) / magnitudes[:, 0] - 1)
    return Errors(
        100.0 * tensors.determined[clear],
        np.degrees(np.arccos(cosines))[clear & tensors.determined],
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


def print_rows(name: str, clouds: Iterable[Samples], noises: Sequence[float], methods: Sequence[str]) -> None:
    """Print a row for each noise and method, of these clouds together."""
    known = list(clouds)
    for noise in noises:
        for method in methods:
            try:
                errors = [errors_of(truth, noise, method, seed) for seed, truth in enumerate(known)]
            except HdpeaError as error:
                click.echo(f"| {name} | {noise:.1%} | {method} | {error.message} |")
            else:
                print_row(name, noise, method, errors)


def samples_of_mesh(path: Path, count: int) -> Samples:
    """Draw points of a mesh, with its own curvature there."""
    vertices, faces = read_mesh(path)
    truth = embed_mesh(vertices, faces)
    seed = zlib.crc32(path.stem.encode()) % 100_000
    points = truth.frame.to_unit(sample_surface(vertices, faces, SamplingOptions(points=count, seed=seed)).points)
    here = truth.at(points)
    return Samples(points, here.curvatures, here.direction1)


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
def main(*, folder: Path, points: int, surfaces: str, meshes: str | None, noise: str, methods: str) -> None:
    """Print the errors on analytic surfaces, and on the meshes of FOLDER: median / 90 % of the points."""
    noises = [float(each.rstrip("%")) / (100 if each.endswith("%") else 1) for each in listed(noise)]
    click.echo(f"| {' | '.join(HEADER)} |")
    click.echo("|---" * len(HEADER) + "|")
    for name in listed(surfaces):
        print_rows(name, [samples_of(SURFACES[name], points)], noises, listed(methods))
    paths = [path for path in sorted(folder.glob("*.ply")) if meshes is None or path.stem in listed(meshes)]
    if paths:
        clouds = [samples_of_mesh(path, points) for path in paths]
        print_rows(f"{len(paths)} meshes", clouds, noises, listed(methods))


if __name__ == "__main__":
    main()
