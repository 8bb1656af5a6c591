# SPDX-License-Identifier: GPL-3.0-or-later
"""Building a dataset of many meshes: in parallel, resumable, and whatever happens to single meshes."""

from __future__ import annotations

import os
import time
import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path

from hdpea.dataset.augmentation import TRANSFORMS, augmented
from hdpea.dataset.build_folder import open_folder
from hdpea.dataset.card import write_card
from hdpea.dataset.discovery import find_meshes
from hdpea.dataset.manifest import Manifest, MeshEntry, SampleEntry, write_manifest
from hdpea.dataset.manifest_options import options_for_manifest
from hdpea.dataset.options import DatasetOptions
from hdpea.dataset.raycasting import require_embree
from hdpea.dataset.sample_file import encoded
from hdpea.dataset.sample_generation import make_sample
from hdpea.dataset.sources import Source
from hdpea.dataset.surface_file import read_surface
from hdpea.errors import QualityMissed, core_errors_translated
from hdpea.runtime.outputs import check_outside, replacing
from hdpea.runtime.processes import Outcome, run_isolated
from hdpea.version import version

IDENTITY = "identity"

SAMPLES = "samples"
"""The folder of the samples in that of the dataset."""


@dataclass(frozen=True)
class Task:
    """What a worker process needs to make the samples of one mesh."""

    source: Source
    options: DatasetOptions
    seed: int
    threads: int


@dataclass(frozen=True)
class EncodedSample:
    """The content of the file of a sample, and the augmentation applied to it, if any."""

    augmentation: str | None
    points: int
    content: bytes


@dataclass(frozen=True)
class BuildResult:
    """The result of a build: its manifest, and how many of its meshes were `kept` from an earlier run."""

    manifest: Manifest
    kept: int
    seconds: float


def build_dataset(
    where: str,
    folder: Path,
    options: DatasetOptions | None = None,
    log: Callable[[str], None] = lambda _: None,
) -> BuildResult:
    """Build the dataset of the meshes that `where` names (see ``find_meshes``) in `folder`, or resume doing so.

    A mesh that cannot be used is skipped, and the manifest says why. What an earlier run with the same options
    finished is kept. The bytes depend only on the meshes, the options and the version; not on the number of jobs,
    nor on whether a run was killed and resumed.

    Parameters
    ----------
    log
        Called with a line about each mesh.

    Raises
    ------
    UnreadableInput
        If there are no meshes.
    UsageError
        If `folder` cannot be written, or holds anything but a dataset of these meshes and options; if a mesh lies
        where the samples go; if scans are requested and embreex is not installed.
    QualityMissed
        If no mesh could be used.
    """
    started, options = time.perf_counter(), options or DatasetOptions()
    if options.sample.kind == "scan":
        require_embree()  # reported once, not for every mesh
    sources = find_meshes(where)
    check_outside(folder / SAMPLES, [each.path for each in sources])
    manifest = Manifest(version(), options_for_manifest(options))
    finished = open_folder(folder, manifest, sources)
    done = dict(finished)
    for name in done:
        log(f"{name}: is there already")
    jobs = options.jobs or os.cpu_count() or 1
    tasks = [
        Task(source, options, seed_of(source.name, options.seed), max((os.cpu_count() or 1) // jobs, 1))
        for source in sources
        if source.name not in done
    ]
    for outcome in run_isolated(make_samples, tasks, jobs, options.time_limit):
        entry = _entry(folder, tasks[outcome.index], outcome)
        done[entry.name] = entry
        manifest = replace(manifest, meshes=tuple(done[name] for name in sorted(done)))
        write_manifest(folder, manifest)
        log(f"{entry.name}: {_described(entry, outcome.seconds)} ({len(done)} of {len(sources)})")
    manifest = replace(manifest, meshes=tuple(done[name] for name in sorted(done)))
    write_manifest(folder, manifest)
    write_card(folder, manifest)
    if not manifest.samples:
        raise QualityMissed(f"None of the {len(sources)} meshes could be used.", "The reasons are above.")
    return BuildResult(manifest, len(finished), time.perf_counter() - started)


def seed_of(name: str, seed: int) -> int:
    """Return the seed of a mesh, which depends only on its name and the dataset's seed."""
    return zlib.crc32(f"{seed}:{name}".encode())


def make_samples(task: Task) -> list[EncodedSample]:
    """Return the encoded samples of a mesh: one, or all ten augmentations if the options ask for them.

    Raises
    ------
    UnreadableInput
        If the mesh cannot be read.
    CannotReconstruct
        If it is not a closed surface, or cannot be embedded.
    """
    from hdpea import _core

    _core.set_thread_limit(task.threads)
    with core_errors_translated():
        sample = make_sample(*read_surface(task.source.path), task.options, task.seed)
    made = [EncodedSample(None, len(sample.points), encoded(sample))]
    if task.options.sample.augmented:
        made += [
            EncodedSample(name, len(sample.points), encoded(augmented(sample, matrix)))
            for name, matrix in TRANSFORMS.items()
            if name != IDENTITY
        ]
    return made


def _entry(folder: Path, task: Task, outcome: Outcome[list[EncodedSample]]) -> MeshEntry:
    """Write the samples of a mesh, and return its entry in the manifest."""
    source = task.source
    entry = MeshEntry(source.name, source.source, source.origin, source.licence, source.sha256(), task.seed)
    if outcome.result is None:
        # The manifest must not depend on where the meshes are.
        return replace(entry, skipped=outcome.failed.replace(str(source.path), source.source))
    return replace(entry, samples=tuple(_written(folder, source.name, made) for made in outcome.result))


def _written(folder: Path, mesh: str, made: EncodedSample) -> SampleEntry:
    name = mesh if made.augmentation is None else f"{mesh}.{made.augmentation}"
    path = folder / SAMPLES / f"{name}.npz"
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as partial:
        partial.write_bytes(made.content)
    file = path.relative_to(folder).as_posix()
    digest = sha256(made.content).hexdigest()
    return SampleEntry(name, file, made.augmentation, made.points, len(made.content), digest)


def _described(entry: MeshEntry, seconds: float) -> str:
    if entry.skipped is not None:
        return f"skipped: {entry.skipped}"
    points, size = sum(each.points for each in entry.samples), sum(each.bytes for each in entry.samples)
    return f"{points:,} points, {size / 1e6:.1f} MB, {seconds:.1f} s"
