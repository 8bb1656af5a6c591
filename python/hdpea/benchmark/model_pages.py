# SPDX-License-Identifier: GPL-3.0-or-later
"""A page for each model: its results to be turned side by side, coloured by their distance to the truth."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from hdpea.benchmark.gallery import PICTURES
from hdpea.benchmark.model import Model
from hdpea.benchmark.record import Record, file_name
from hdpea.benchmark.run import evenly, mesh_path, model_of, sources_of
from hdpea.benchmark.suite import Suite
from hdpea.pages.colorings import DISTANCE, mesh_shape, point_shape
from hdpea.pages.page import write_page
from hdpea.pages.shapes import Shape
from hdpea.reading.triangle_mesh import read_triangle_mesh


def page_path(folder: Path, record: Record) -> Path:
    """Return the path of the page that shows the result of a run beside those of other methods."""
    return folder / PICTURES / f"{file_name(f'{record.model}-{record.given}-{record.vertices}')}.html"


def write_model_pages(
    suite: Suite, meshes: str, folder: Path, records: Sequence[Record], log: Callable[[str], None] = lambda _: None
) -> None:
    """Write a page for each input and number of vertices of the models that are pictured (``draw_gallery``)."""
    for source in evenly(sources_of(suite, meshes), suite.options.pictures) if suite.options.pictures else ():
        log(f"showing {source.name}")
        model = model_of(suite, source)
        finished = [each for each in records if each.model == source.name and not each.failed]
        pages = {page_path(folder, each): (each.given, each.vertices) for each in finished}
        for path, key in pages.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            shown = [each for each in finished if (each.given, each.vertices) == key]
            title = f"{source.name}: {key[0]}, {key[1]:,} vertices"
            figures = [("unit of lengths", "longest side of the truth")]
            write_page(path, title, list(_shapes(model, folder, shown)), figures, coloring=DISTANCE, beside=1)


def _shapes(model: Model, folder: Path, records: Sequence[Record]) -> Iterator[Shape]:
    truth = model.truth
    for record in records:
        vertices, faces = read_triangle_mesh(mesh_path(folder, record))
        yield mesh_shape(record.method, np.ascontiguousarray(truth.from_world(vertices)), faces, truth.points)
    if truth.surface is not None:
        yield mesh_shape("the truth", *truth.surface)
    else:
        yield point_shape("the truth", truth.points)
