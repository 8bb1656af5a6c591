# SPDX-License-Identifier: GPL-3.0-or-later
"""One mesh: what is read, made and written for it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from hdpea.cli.destinations import Destination
from hdpea.cli.ended import Ended
from hdpea.cli.tiles import Resources, stream_beyond
from hdpea.errors import HdpeaError, QualityMissed, UsageError, core_errors_translated
from hdpea.options import Options
from hdpea.runtime.progress import ProgressCallback, tell

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from hdpea.reading.streaming import PointStream
    from hdpea.report.report import Report
    from hdpea.result import Reconstruction
    from hdpea.runtime.clock import StageClock


@dataclass(frozen=True)
class Job:
    """A mesh that is wanted, and what else is to be written about it."""

    destination: Destination
    options: Options
    report: Path | None = None
    dropped: Path | None = None
    picture: Path | None = None
    page: Path | None = None
    up: str | None = None
    resources: Resources = field(default_factory=Resources)

    def outputs(self) -> list[tuple[Path, str]]:
        """Return the files that are to be written, and the kind of each."""
        from hdpea.writing.outputs import level_path, mesh_outputs

        mesh, outputs = self.destination.output, list[tuple[Path, str]]()
        if mesh is not None:
            outputs += mesh_outputs(mesh, textured=self.options.texture is not None)
            for number in range(1, self.options.meshing.lod):
                outputs += mesh_outputs(level_path(mesh, number), textured=False)
        kinds = {"report": self.report, "picture": self.picture, "page": self.page}
        kinds["set of dropped points"] = self.dropped
        return outputs + [(path, kind) for kind, path in kinds.items() if path is not None]


def make_mesh(job: Job, progress: ProgressCallback | None) -> Report:
    """Read, reconstruct and write; the report is that of the mesh, and lists what was missed.

    Raises
    ------
    HdpeaError
        Of any kind, if there is no mesh.
    """
    from hdpea.reading import read_scans
    from hdpea.runtime.clock import StageClock
    from hdpea.runtime.pytorch import load_in_background

    clock, sources = StageClock(), job.destination.sources
    tell(progress, "reading", 0.0)
    stream = stream_beyond(sources, job.options, job.resources)
    if stream is not None:
        return _make_in_tiles(job, stream, clock, progress)
    with clock.stage("reading"):
        cloud = read_scans(sources)
    if not job.resources.suffice(len(cloud.points), job.options, normals=cloud.normals is not None):
        from hdpea.reading.streaming import stream_of_cloud

        return _make_in_tiles(job, stream_of_cloud(cloud, ", ".join(sources)), clock, progress)
    # PyTorch takes seconds to load, so this comes after all that may be wrong with the request.
    tell(progress, "start-up", 0.0)
    with clock.stage("start-up"):
        load_in_background()
        from hdpea.reconstruction import reconstruct

    result = reconstruct(cloud, options=job.options, progress=progress)
    _write(job, result, clock, progress)
    if job.dropped:
        from hdpea.writing.points import write_dropped

        write_dropped(job.dropped, result.dropped.points, result.dropped.reasons)
    if job.picture:
        from hdpea.pictures.camera import mean_sight

        _draw(job.picture, job, result, mean_sight(cloud.points, cloud.sensors()), progress)
    if job.page:
        from hdpea.report.page import write_result_page

        tell(progress, "page", 0.0)
        mesh, title = (result.vertices, result.faces), ", ".join(Path(each).name for each in sources)
        write_result_page(job.page, title, mesh, cloud, result.report, result.attributes, job.up)
    return result.report


def _make_in_tiles(job: Job, stream: PointStream, clock: StageClock, progress: ProgressCallback | None) -> Report:
    """Make the mesh of a cloud that is larger than memory."""
    from hdpea.tiling.run import Tiling, reconstruct_in_tiles

    if job.dropped or job.page:
        raise UsageError("`dropped` and `page` need the cloud in one piece.", "Leave them away, or give more `memory`.")
    given = job.resources
    tiling = Tiling(given.work_folder(job.destination.output), given.bytes(), given.jobs, given.scheduler)
    result = reconstruct_in_tiles(stream, tiling, job.options, progress)
    _write(job, result, clock, progress)
    if job.picture:
        _draw(job.picture, job, result, None, progress)
    return result.report


def _write(job: Job, result: Reconstruction, clock: StageClock, progress: ProgressCallback | None) -> None:
    """Write the mesh and its report, which begins with what `clock` has measured so far."""
    result.report.begin_with(", ".join(job.destination.sources), clock)
    tell(progress, "writing", 0.0)
    with result.report.clock.stage("writing"):
        _write_mesh(job, result)
    if job.report:
        result.report.write(job.report)


def _draw(
    path: Path, job: Job, result: Reconstruction, sight: NDArray[np.float64] | None, progress: ProgressCallback | None
) -> None:
    from hdpea.pictures.picture import Camera, draw_mesh
    from hdpea.writing.attributes import colors_of

    tell(progress, "picture", 0.0)
    camera = Camera.before(result.vertices, result.faces, sight, job.up)
    draw_mesh(path, result.vertices, result.faces, camera=camera, colors=colors_of(result.attributes))


def _write_mesh(job: Job, result: Reconstruction) -> None:
    from hdpea.writing.meshes import mesh_content

    destination = job.destination
    if destination.output is not None:
        result.write(destination.output, up=job.up, force=True)  # the command has asked before the work
        return
    mesh = result.vertices, result.faces, result.attributes, result.crs, result.texture
    content, _ = mesh_content(destination.extension, *mesh, up=job.up)
    sys.stdout.buffer.write(content)
    sys.stdout.buffer.flush()


def remarks(job: Job, report: Report) -> Iterator[str]:
    """Yield what else there is to say to whoever waits for a mesh: a line each."""
    others = [str(path) for path, _ in job.outputs() if path != job.destination.output and path.exists()]
    if others:
        yield f"Also written: {', '.join(others)}"
    if job.destination.extension == ".stl" and not report.mesh.closed:
        yield "The mesh is open; a 3D printer needs a closed one: --watertight makes it so."


def missed(job: Job, report: Report) -> QualityMissed | None:
    """Return the error of a mesh that is not what was asked for, if it is not."""
    if not report.missed:
        return None
    return QualityMissed(" ".join(report.missed), f"The mesh is in {job.destination.name} all the same.")


def attempt(job: Job) -> Ended:
    """Do a job in a process of its own."""
    try:
        with core_errors_translated():
            report = make_mesh(job, None)
    except HdpeaError as error:
        return Ended.of(job.destination, None, error)
    return Ended.of(job.destination, report, missed(job, report))
