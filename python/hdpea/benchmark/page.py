# SPDX-License-Identifier: GPL-3.0-or-later
"""The results as one self-contained HTML file: tables, curves, and pictures side by side."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from urllib.parse import quote

from hdpea.benchmark.gallery import Gallery
from hdpea.benchmark.means import means_of
from hdpea.benchmark.model_pages import page_path
from hdpea.benchmark.record import LARGEST, RMS, Record
from hdpea.benchmark.scene import ERROR_COLORS, RED_FROM
from hdpea.benchmark.suite import HELD_OUT, MESH, Suite
from hdpea.benchmark.tables import cells_of, quoted_cells
from hdpea.benchmark.winners import winner_sentences
from hdpea.runtime.outputs import replacing

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 1500px; padding: 0 1rem; color: #1f2937 }
h1 { margin-bottom: 0 } h2 { margin-top: 2.2rem; border-bottom: 1px solid #d1d5db } p.small { color: #6b7280 }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums }
table { display: block; overflow-x: auto }
th, td { padding: .25rem .45rem; text-align: right; border-bottom: 1px solid #e5e7eb; white-space: nowrap }
th:first-child, td:first-child { text-align: left } td.best { font-weight: 700; color: #15803d }
.row { display: flex; gap: .6rem; overflow-x: auto } figure { margin: 0; flex: 0 0 230px }
figure img { width: 230px; height: 230px; cursor: zoom-in; border: 1px solid #e5e7eb; display: block }
figcaption { font-size: 13px; line-height: 1.3; padding: .2rem 0 .6rem }
.scale { height: 12px; width: 260px; display: inline-block; vertical-align: middle; border: 1px solid #d1d5db }
dialog { border: 0; padding: 0; max-width: 96vmin } dialog img { width: 94vmin; cursor: zoom-out; display: block }
dialog::backdrop { background: #0009 }
"""

SCRIPT = """
const dialog = document.querySelector("dialog"), large = dialog.querySelector("img");
document.querySelectorAll("figure img").forEach(each =>
  each.addEventListener("click", () => { large.src = each.src; dialog.showModal(); }));
dialog.addEventListener("click", () => dialog.close());
"""

ERROR_MAPS = {
    MESH: "from the surface of the result to the truth",
    HELD_OUT: "from each point of the truth to the surface of the result",
}
"""Caption of the error maps, by the kind of the truth."""


def write_page(
    path: Path,
    suite: Suite,
    records: Sequence[Record],
    gallery: Gallery,
    curves: Mapping[str, str],
    subtitle: Sequence[str],
) -> None:
    """Write the page, whole or not at all; `subtitle` is printed below the title.

    Raises
    ------
    UsageError
        If it cannot be written.
    """
    body = "\n".join(
        [*_tables(suite, records), *curves.values(), *_gallery(path.parent, suite, records, gallery), *_quoted(suite)]
    )
    title = escape(suite.options.title or suite.name)
    small = "".join(f'<p class="small">{escape(each)}</p>' for each in subtitle)
    with replacing(path) as partial:
        partial.write_text(
            f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
            f"<style>{STYLE}</style></head><body><h1>{title}</h1>{small}{body}"
            f"<dialog><img alt=''></dialog><script>{SCRIPT}</script></body></html>\n"
        )


def _tables(suite: Suite, records: Sequence[Record]) -> Iterator[str]:
    for given in suite.inputs:
        for vertices in suite.options.vertices:
            yield f"<h2>{escape(given.name)}, {vertices:,} vertices</h2>"
            yield _table(*cells_of(means_of(records, suite, given.name, vertices)))
            yield f'<p class="small">{escape(winner_sentences(records, suite, given.name, vertices))}</p>'


def _quoted(suite: Suite) -> Iterator[str]:
    if suite.quoted:
        titles, rows = quoted_cells(suite.quoted)
        yield "<h2>Published elsewhere, on other data</h2>"
        yield _table(titles, [[(cell, False) for cell in row] for row in rows])


def _table(titles: Sequence[str], rows: Sequence[Sequence[tuple[str, bool]]]) -> str:
    head = "".join(f"<th>{escape(title)}</th>" for title in titles)
    lines = [
        "".join(f'<td class="best">{escape(cell)}</td>' if best else f"<td>{escape(cell)}</td>" for cell, best in row)
        for row in rows
    ]
    return f"<table><tr>{head}</tr>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def _gallery(folder: Path, suite: Suite, records: Sequence[Record], gallery: Gallery) -> Iterator[str]:
    if not gallery.truths:
        return
    colors = ", ".join(f"rgb({r}, {g}, {b})" for r, g, b in ERROR_COLORS)
    yield "<h2>Side by side</h2>"
    yield (
        f"<p>Error, {ERROR_MAPS[suite.options.truth]}: 0 "
        f'<span class="scale" style="background: linear-gradient(to right, {colors})"></span> '
        f"{100 * RED_FROM:g} % of the longest side and more. Brown: the inside of a face. A click enlarges.</p>"
    )
    for model, truth in gallery.truths.items():
        for given in suite.inputs:
            for vertices in suite.options.vertices:
                shown = [
                    record
                    for record in records
                    if (record.model, record.given, record.vertices) == (model, given.name, vertices)
                ]
                yield f"<h3>{escape(model)}: {escape(given.name)}, {vertices:,} vertices</h3>"
                yield f"{_link(folder, shown)}<div class='row'>"
                yield f"<figure>{_image(truth)}<figcaption>the truth</figcaption></figure>"
                yield from (_figure(record, gallery) for record in shown)
                yield "</div>"


def _link(folder: Path, records: Sequence[Record]) -> str:
    """Return a link to the page of these runs, if there is one."""
    path = page_path(folder, records[0]) if records else None
    if path is None or not path.is_file():
        return ""
    return f'<p><a href="{escape(quote(path.relative_to(folder).as_posix()))}">Turn them</a></p>'


def _figure(record: Record, gallery: Gallery) -> str:
    pictures = gallery.results.get(record.stem)
    if pictures is None:
        return f"<figure><figcaption>{escape(record.method)}: {escape(record.failed)}</figcaption></figure>"
    rms = 1e2 * (record.score(*RMS) or 0.0)
    largest = 1e2 * (record.score(*LARGEST) or 0.0)
    facts = f"{record.score('topology.vertices') or 0:,.0f} vertices, rms {rms:.3f} %, max {largest:.2f} %"
    g = record.score("triangles.g")
    quality = "" if g is None else f"G {g:.3f}"
    caption = f"<b>{escape(record.method)}</b><br>{facts}<br>{quality}"
    return f"<figure>{_image(pictures.surface)}{_image(pictures.error)}<figcaption>{caption}</figcaption></figure>"


def _image(path: Path) -> str:
    return f'<img alt="" loading="lazy" src="data:image/webp;base64,{b64encode(path.read_bytes()).decode()}">'
