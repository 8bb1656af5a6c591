# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of a suite's results, drawn if they are missing or older than their mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from hdpea.benchmark.model import Model
from hdpea.benchmark.record import Record, file_name
from hdpea.benchmark.run import evenly, mesh_path, model_of, sources_of
from hdpea.benchmark.suite import Suite
from hdpea.reading.triangle_mesh import read_triangle_mesh
from hdpea.runtime.outputs import replacing

PICTURES = "pictures"
QUALITY = 80
"""Quality of WebP, 0 to 100."""


@dataclass(frozen=True)
class Pictures:
    """The two pictures of a result: the surface with its edges, and the error."""

    surface: Path
    error: Path


@dataclass(frozen=True)
class Gallery:
    """Pictures of the truth by the name of the model, and of the results by the stem of their record."""

    truths: dict[str, Path]
    results: dict[Path, Pictures]


def draw_gallery(
    suite: Suite, meshes: str, folder: Path, records: Sequence[Record], log: Callable[[str], None] = lambda _: None
) -> Gallery:
    """Draw the results of as many models as the suite says, in ``pictures/``; ``check_drawing`` first."""
    gallery = Gallery({}, {})
    if suite.options.pictures == 0:
        return gallery
    for source in evenly(sources_of(suite, meshes), suite.options.pictures):
        log(f"drawing {source.name}")
        _draw_model(gallery, model_of(suite, source), folder, [each for each in records if each.model == source.name])
    return gallery


def _draw_model(gallery: Gallery, model: Model, folder: Path, records: Sequence[Record]) -> None:
    finished = [each for each in records if not each.failed]
    if not finished:
        return
    scene = model.scene()
    truth = folder / PICTURES / f"{file_name(model.name)}.webp"
    _drawn(truth, model.source.path, scene.draw_truth)
    gallery.truths[model.name] = truth
    for record in finished:
        path = mesh_path(folder, record)
        base = folder / PICTURES / record.stem
        pictures = Pictures(base.with_name(f"{base.name}.webp"), base.with_name(f"{base.name}.error.webp"))
        mesh = read_triangle_mesh(path)
        _drawn(pictures.surface, path, partial(scene.draw, mesh=mesh))
        _drawn(pictures.error, path, partial(scene.draw_error, mesh=mesh))
        gallery.results[record.stem] = pictures


def _drawn(picture: Path, mesh: Path, draw: Callable[[Path], None]) -> None:
    """Draw a picture, unless one exists that is newer than the mesh."""
    if picture.exists() and picture.stat().st_mtime > mesh.stat().st_mtime:
        return
    from PIL import Image

    picture.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as temporary:
        drawn = Path(temporary) / "drawn.png"
        draw(drawn)
        # A fifth of the size of PNG, which matters since the page contains all of them.
        with Image.open(drawn) as image, replacing(picture) as partial:
            image.convert("RGB").save(partial, "WEBP", quality=QUALITY)
