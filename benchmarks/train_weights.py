# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of the learned embedding, from meshes to a file, in so many minutes of training.

    python benchmarks/train_weights.py MESHES VALIDATION OUT --minutes 10 --preset gpu
    python benchmarks/train_weights.py MESHES VALIDATION OUT --dry-run

Makes samples of MESHES, unless OUT/packed.safetensors is there already, since it may have been made elsewhere and have
travelled; trains on them; scores the weights by reconstructions of VALIDATION, beside those to start from; leaves
OUT/training/last.safetensors. Each mesh gives a clean sample and a scan with faults drawn at random. Not used are
meshes whose licence forbids commercial use, and a tenth, by a hash of the name: the second validation set.
OUT/sets.json says which. A run that was stopped is continued by the same command. The dry run takes three meshes and
half a minute.
"""

from __future__ import annotations

import json
import os
import time
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import click
import numpy as np

from hdpea import _core
from hdpea.dataset.discovery import find_meshes
from hdpea.dataset.ground_truth import embed_mesh
from hdpea.dataset.normal_estimation import estimated_normals
from hdpea.dataset.options import DatasetOptions, GroundTruthOptions, SampleOptions, SamplingOptions, ScanOptions
from hdpea.dataset.quality import spacing_of
from hdpea.dataset.sample import Sample
from hdpea.dataset.sample_file import read_sample, write_sample
from hdpea.dataset.sample_generation import draw_points
from hdpea.dataset.sources import Source
from hdpea.dataset.surface_file import read_surface
from hdpea.geometry.metric import ScaledMetric
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.network.settling import ROUNDS
from hdpea.network.weights import SHIPPED, read_weights
from hdpea.runtime.processes import run_isolated
from hdpea.training.loop import train
from hdpea.training.options import PRESETS
from hdpea.training.packed import Packed, write_packed
from hdpea.training.validation import validate

NONCOMMERCIAL = ("noncommercial", "non-commercial", "by-nc")
HELD_OUT = 0.1
CLEAN_POINTS = 60_000
LOWEST_DENSITY = 10_000
"""Fewest points that a whole cloud is thinned to: 2 for each of 5,000 vertices."""


@dataclass(frozen=True)
class Task:
    """A mesh, and where its samples go."""

    source: Source
    folder: Path
    scanned: bool


@dataclass(frozen=True)
class Folder:
    """Samples in a folder, of the default ground truth."""

    folder: Path

    @property
    def names(self) -> list[str]:
        """Their names, in order."""
        return sorted(path.stem for path in self.folder.glob("*.npz"))

    @property
    def metric(self) -> ScaledMetric:
        """That of the ground truth, in spacings."""
        return GroundTruthOptions().metric

    def read(self, name: str) -> Sample:
        """Read one."""
        return read_sample(self.folder / f"{name}.npz")

    def spacing(self, name: str) -> float:
        """Return its spacing; that of a scan, which shows less area, is its mesh's."""
        return float(spacing_of(self.read(name.replace(".scan", ".clean")), GroundTruthOptions()))


def drawn_faults(random: np.random.Generator, seed: int) -> ScanOptions:
    """Return how a mesh is scanned: each fault in three of ten scans."""

    def sometimes(most: float) -> float:
        return most * random.random() if random.random() < 0.3 else 0.0

    return ScanOptions(
        sensor=("views", "turntable", "lidar")[random.integers(3)],
        views=int(random.integers(4, 13)),
        coverage=float(random.choice([1.0, 1.0, 0.6])),
        ring_ratio=float(random.uniform(2, 8)),
        noise=1e-3 * random.random() ** 2,
        flying=sometimes(0.3),
        misrotated=sometimes(0.2),
        misplaced=sometimes(0.002),
        outliers=sometimes(0.01),
        seed=seed,
    )


def make_samples(task: Task) -> None:
    """Write the samples of a mesh, which share its true embedding; the clean one last, as the sign that all are."""
    _core.set_thread_limit(1)
    seed = zlib.crc32(task.source.name.encode())
    vertices, faces = read_surface(task.source.path)
    frame, mesh = UnitFrame.around(vertices), embed_mesh(vertices, faces)
    clean = DatasetOptions(sampling=SamplingOptions(points=CLEAN_POINTS))
    scan = DatasetOptions(sample=SampleOptions(kind="scan"), scanning=drawn_faults(np.random.default_rng(seed), seed))
    kinds = {"scan": scan, "clean": clean} if task.scanned else {"clean": clean}
    for kind, options in kinds.items():
        points, surface_points, normals, _ = draw_points(frame.to_unit(vertices), faces, options, seed)
        truth = mesh.at(surface_points)
        arrays = (points, surface_points, normals, truth.psi, truth.curvatures, truth.direction1)
        estimated = estimated_normals(points) if kind == "scan" else None
        sample = Sample(*(each.astype(np.float32) for each in arrays), frame, estimated)
        write_sample(task.folder / f"{task.source.name}.{kind}.npz", sample)


def make_missing(sources: Iterable[Source], folder: Path, jobs: int, *, scanned: bool) -> Folder:
    """Make the samples that are not there yet, and say which meshes cannot be used."""
    folder.mkdir(parents=True, exist_ok=True)
    tasks = [Task(each, folder, scanned) for each in sources if not (folder / f"{each.name}.clean.npz").exists()]
    for outcome in run_isolated(make_samples, tasks, jobs):
        if outcome.failed:
            click.echo(f"{tasks[outcome.index].source.name}: {outcome.failed}")
    return Folder(folder)


def split(meshes: str, out: Path) -> list[Source]:
    """Return the meshes to train on; write which are, which are held out, and which have such a licence."""
    sources = find_meshes(meshes)
    barred = [each for each in sources if any(word in each.licence.lower() for word in NONCOMMERCIAL)]
    rest = sorted(set(sources) - set(barred), key=lambda each: zlib.crc32(each.name.encode()))
    held = 1 + int(HELD_OUT * len(rest))
    sets = {"noncommercial": barred, "held_out": rest[:held], "training": rest[held:]}
    content = {name: {each.name: each.licence for each in members} for name, members in sets.items()}
    (out / "sets.json").write_text(json.dumps(content, indent=1))
    return rest[held:]


@click.command()
@click.argument("meshes")
@click.argument("validation")
@click.argument("out", type=click.Path(path_type=Path))
@click.option("--minutes", default=10.0, show_default=True, help="of training")
@click.option("--preset", default="cpu", type=click.Choice(list(PRESETS)), show_default=True)
@click.option(
    "--start", type=click.Path(path_type=Path), default=SHIPPED, help="weights to start from; default: those shipped"
)
@click.option("--jobs", default=os.cpu_count(), help="meshes sampled at a time; default: one per core")
@click.option("--count", default=4, show_default=True, help="meshes of VALIDATION to reconstruct")
@click.option("--dry-run", is_flag=True)
def main(
    *,
    meshes: str,
    validation: str,
    out: Path,
    minutes: float,
    preset: str,
    start: Path,
    jobs: int,
    count: int,
    dry_run: bool,
) -> None:
    """Make weights, and say how long each part took."""
    began = time.monotonic()

    def tell(what: str) -> None:
        click.echo(f"{time.monotonic() - began:7.1f} s: {what}")

    out.mkdir(parents=True, exist_ok=True)
    packed = out / "packed.safetensors"
    if not packed.exists():
        sources = split(meshes, out)
        samples = make_missing(sources[:3] if dry_run else sources, out / "samples", jobs, scanned=True)
        write_packed(packed, samples)
        tell(f"{len(samples.names)} samples, {packed.stat().st_size / 1e6:.0f} MB packed")
    options = replace(PRESETS[preset], minutes=0.5 if dry_run else minutes)
    options = replace(options, crops=replace(options.crops, least_density=LOWEST_DENSITY), save_minutes=1)
    (out / "training").mkdir(exist_ok=True)
    first = read_weights(start)
    training = train(Packed(packed), None, out / "training", first.options, options, tell=tell, start=first)
    tell(f"{training.step} steps of {options.batch} crops on {training.workers.device}")
    judged = make_missing(find_meshes(validation)[: 1 if dry_run else count], out / "validation", jobs, scanned=False)
    click.echo("| weights | rounds | T3 | G |\n|---|---|---|---|")
    for name, network in (("to start from", first), ("trained", training.averaged_network())):
        for rounds in (0, ROUNDS):
            scores = validate(
                network, ((judged.read(each), judged.spacing(each)) for each in judged.names), 5180, rounds
            )
            click.echo(f"| {name} | {rounds} | {scores['t3']:.3f} | {scores['g']:.3f} |")
    tell("done")


if __name__ == "__main__":
    main()
