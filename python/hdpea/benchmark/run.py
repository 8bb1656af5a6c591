# SPDX-License-Identifier: GPL-3.0-or-later
"""All runs of a suite, one after another, resumable."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, replace
from hashlib import sha256
from pathlib import Path
from typing import TypeVar

from hdpea.benchmark.clouds import write_cloud
from hdpea.benchmark.held_out import HeldOut
from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.folder import made_elsewhere
from hdpea.benchmark.model import Model
from hdpea.benchmark.provenance import code
from hdpea.benchmark.record import RMS, Record, file_name, key_of, read_record, write_record
from hdpea.benchmark.suite import HELD_OUT, Suite, SuiteInput, SuiteMethod
from hdpea.benchmark.true_surface import TrueSurface
from hdpea.benchmark.worker import Task, run_method_isolated
from hdpea.dataset.discovery import find_clouds, find_meshes
from hdpea.dataset.raycasting import require_embree
from hdpea.dataset.sources import Source
from hdpea.errors import HdpeaError, UsageError, core_errors_translated
from hdpea.runtime.outputs import check_outside
from hdpea.version import version
from hdpea.writing.meshes import write_mesh

Chosen = TypeVar("Chosen")
RUNS, MESHES, CLOUDS, SURFACES = "runs", "meshes", "clouds", "surfaces"


def sources_of(suite: Suite, where: str) -> list[Source]:
    """Return the files of the models of a suite, as many as it says, out of the meshes or clouds that `where` names.

    Raises
    ------
    UnreadableInput
        If there are none.
    """
    find = find_clouds if suite.options.truth == HELD_OUT else find_meshes
    return evenly(find(where), suite.options.models)


def model_of(suite: Suite, source: Source) -> Model:
    """Return the model in a file: a true surface, or a cloud with points held out, as the suite says."""
    kind = HeldOut if suite.options.truth == HELD_OUT else TrueSurface
    return kind(source, suite.options)


def run_suite(
    suite: Suite,
    meshes: str,
    folder: Path,
    log: Callable[[str], None] = lambda _: None,
) -> list[Record]:
    """Run a suite on the models that `meshes` names (see ``sources_of``); return every record, also of failures.

    Results of an earlier run in `folder` are kept if nothing that they depend on has changed; failures are tried
    again. The folder gets ``clouds/`` (the input of every method), ``surfaces/`` (meshes before their reduction),
    ``meshes/`` and ``runs/``.

    Parameters
    ----------
    log
        Called with a line about each run.

    Raises
    ------
    UnreadableInput
        If there are no models.
    UsageError
        If the folder cannot be written, or a model lies where results go; if scans are requested and embreex is not
        installed.
    """
    if any(given.sample.kind == "scan" for given in suite.inputs):
        require_embree()  # reported once, not for every model
    sources = sources_of(suite, meshes)
    for name in (RUNS, MESHES, CLOUDS, SURFACES):
        check_outside(folder / name, [each.path for each in sources])
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"Cannot write to {folder}: {error.strerror}.", "Choose another folder.") from error
    total = len(sources) * len(suite.inputs) * len(suite.methods) * len(suite.options.vertices)
    records: list[Record] = []
    for source in sources:
        for record, news in _runs_of(suite, model_of(suite, source), folder):
            records.append(record)
            log(f"[{len(records)} of {total}] {record.stem.as_posix()}: {news}")
    return records


def _runs_of(suite: Suite, model: Model, folder: Path) -> Iterator[tuple[Record, str]]:
    """Yield the records of a model, each with a line to log."""
    for given in suite.inputs:
        cloud: Cloud | HdpeaError | None = None
        for method in suite.methods:
            for vertices in suite.options.vertices:
                planned = _planned(suite, model, given, method, vertices)
                path = folder / RUNS / planned.stem.with_name(planned.stem.name + ".json")
                earlier = read_record(path)
                mesh = mesh_path(folder, planned)
                if earlier is not None and earlier.key == planned.key and not earlier.failed and mesh.exists():
                    yield earlier, "is there already"
                    continue
                cloud = cloud or _cloud(model, given, folder)
                record = _run(planned, model, cloud, method, folder)
                write_record(path, record)
                yield record, _news(record)


def mesh_path(folder: Path, record: Record) -> Path:
    """Return the path of the mesh of a run in the folder of the results."""
    return folder / MESHES / record.stem.with_name(record.stem.name + ".ply")


def _planned(suite: Suite, model: Model, given: SuiteInput, method: SuiteMethod, vertices: int) -> Record:
    """Return the record of a run before it is done."""
    file = _file_read(method, model.name, given.name, vertices)
    content = sha256(file.read_bytes()).hexdigest() if file is not None and file.is_file() else None
    of_points = (suite.options.seed, asdict(given), model.content)
    measured = (asdict(model.measuring), suite.options.rendered)
    key = key_of(version(), model.name, of_points, method.method, dict(method.values), content, vertices, measured)
    return Record(model.name, given.name, method.name, vertices, key, code())


def _file_read(method: SuiteMethod, model: str, given: str, vertices: int) -> Path | None:
    """Return the file that a method reads besides the points, if any: a finished mesh, or the weights of a network."""
    if method.method == "folder":
        return made_elsewhere(method.options(), model, given, vertices)
    weights = method.values.get("weights")
    return None if weights is None else Path(str(weights))


def _cloud(model: Model, given: SuiteInput, folder: Path) -> Cloud | HdpeaError:
    """Make the points and write them; if that fails, return the error."""
    try:
        with core_errors_translated():
            cloud = model.cloud(given)
    except HdpeaError as error:
        return error
    write_cloud(folder / CLOUDS / file_name(given.name) / f"{file_name(model.name)}.ply", cloud)
    return cloud


def _run(planned: Record, model: Model, cloud: Cloud | HdpeaError, method: SuiteMethod, folder: Path) -> Record:
    """Run a method, write its mesh and measure it."""
    if isinstance(cloud, HdpeaError):
        return replace(planned, failed=cloud.message)
    surfaces = folder / SURFACES / planned.stem.parent
    task = Task(cloud, method.method, method.values, planned.vertices, surfaces)
    outcome = run_method_isolated(task, model.options.time_limit)
    if outcome.result is None:
        return replace(planned, failed=outcome.failed, seconds=outcome.seconds)
    made = outcome.result
    path = mesh_path(folder, planned)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_mesh(path, *made.mesh)
    done = replace(planned, seconds=made.seconds, cpu_seconds=made.cpu_seconds, peak_bytes=made.peak_bytes)
    try:
        return replace(done, scores=model.scores(made.mesh))
    except HdpeaError as error:
        return replace(done, failed=f"It cannot be measured: {error.message}")


def _news(record: Record) -> str:
    if record.failed:
        return f"failed: {record.failed}"
    rms = record.score(*RMS) or 0.0
    vertices = record.score("topology.vertices") or 0.0
    return f"{vertices:,.0f} vertices, rms {1e2 * rms:.3f} % of the longest side, {record.seconds:.1f} s"


def evenly(items: Sequence[Chosen], count: int) -> list[Chosen]:
    """Return `count` of the items, spread evenly over them; all if `count` is 0."""
    if count == 0 or count >= len(items):
        return list(items)
    return [items[(2 * i + 1) * len(items) // (2 * count)] for i in range(count)]
