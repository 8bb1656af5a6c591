# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea info``: what is in a file, before anything is done with it."""

from __future__ import annotations

import json
import re
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from hdpea.cli.groups import GroupedCommand, GroupedOption
from hdpea.cli.parameters import setting_options
from hdpea.cli.tiles import MemoryType, Resources
from hdpea.errors import UsageError

if TYPE_CHECKING:
    from hdpea.options.classes import Classes
    from hdpea.report.inspection import CloudFacts

EPILOG = """\b
Examples:
  hdpea info scan.ply
  hdpea info scan.ply --json
  hdpea info flight.laz --classes 2,6 --memory 4GB
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Say what is in a point cloud.")
@click.argument("source", metavar="IN", type=click.Path())
@click.option("--json", "as_json", cls=GroupedOption, is_flag=True, help="print the facts as JSON")
@click.option(
    "--memory",
    cls=GroupedOption,
    type=MemoryType(),
    help="memory that a run may take, as 4GB; default: half of what the machine has",
)
@setting_options(also=["classes"], heading="General")
def command(source: str, as_json: bool, memory: float | None, classes: Classes | None) -> None:
    """Say what is in the point cloud IN, and what making a mesh of it would take.

    That includes what a run would leave out: points that lie on no surface, or crowd on scan lines.
    Lengths are in the units of the file. IN is as for reconstruct. Of a million points and more in
    LAS, LAZ, COPC or binary PLY a sample is looked at.
    """
    facts = _facts(source, classes)
    click.echo(json.dumps(asdict(facts), indent=2) if as_json else _describe(facts, Resources(memory)))


def _facts(source: str, classes: Classes | None) -> CloudFacts:
    from hdpea.frontend.classes import of_classes, stream_of_classes
    from hdpea.reading import read_points
    from hdpea.reading.streaming import stream_of
    from hdpea.report.inspection import inspect
    from hdpea.report.sampling import MOST_WHOLE, inspect_stream

    stream = stream_of(Path(source))
    if stream is None or stream.count <= MOST_WHOLE:
        cloud = read_points(source)
        return inspect(cloud if classes is None else of_classes(cloud, classes))
    return inspect_stream(stream if classes is None else stream_of_classes(stream, classes))


def _describe(facts: CloudFacts, resources: Resources) -> str:
    extent = [high - low for low, high in zip(facts.low, facts.high, strict=True)]
    rows = {
        "format": facts.format,
        "points": f"{facts.counts['points']:,}",
        "attributes": ", ".join(facts.attributes) or "none",
        "classes": _classes(facts),
        "from": _triple(facts.low),
        "to": _triple(facts.high),
        "extent": " x ".join(f"{length:.6g}" for length in extent) + f", diagonal {facts.diagonal:.6g}",
        "spacing": _spacing(facts),
        "normals": _normals(facts),
        "crs": crs_name(facts.crs),
        "a run needs": _needs(facts, resources),
    }
    return "\n".join([*(f"{name:<12}{value}" for name, value in rows.items() if value), *facts.notes])


MOST_CLASSES = 12
"""Classes that are listed: a survey has fewer, and a label of every object more."""


def _classes(facts: CloudFacts) -> str:
    if facts.classes is None or len(facts.classes) > MOST_CLASSES:
        return ""
    return ", ".join(f"{number} ({points:,} points)" for number, points in facts.classes.items())


def crs_name(crs: str | None) -> str:
    """Return the name of a coordinate reference system in WKT, and its number if it ends with that; else all of it."""
    if crs is None:
        return "not told by the file"
    name = re.match(r'\s*\w+\["([^"]+)"', crs)
    if name is None:
        return crs
    number = re.search(r'(?:ID|AUTHORITY)\["EPSG",\s*"?(\d+)"?\]\s*\]\s*$', crs)
    return name[1] if number is None else f"{name[1]} (EPSG:{number[1]})"


def _triple(numbers: list[float]) -> str:
    return " ".join(f"{number:.12g}" for number in numbers)


def _spacing(facts: CloudFacts) -> str:
    if facts.spacing is None:
        return "unknown"
    surface = "" if facts.surface_spacing is None else f", {facts.surface_spacing:.4g} along the surface"
    return f"{facts.spacing:.4g} (median to the nearest point){surface}"


def _normals(facts: CloudFacts) -> str:
    usable, unusable = facts.counts["usable_normals"], facts.counts["unusable_normals"]
    if not usable:
        return "none usable, will be estimated" if unusable else "none, will be estimated"
    if facts.normal_agreement is None:
        return f"{usable:,} usable"
    if not facts.normals_fit:
        return f"{usable:,}, which do not lie across the surface: they will be estimated instead"
    fate = "their orientation will be kept" if facts.normals_oriented else "they will be oriented anew"
    return f"{usable:,} usable, {facts.normal_agreement:.1%} of neighbours agree on the side: {fate}"


ONE_PIECE = "--error and colours are for one piece: cut a larger cloud yourself"


def _needs(facts: CloudFacts, resources: Resources) -> str:
    from hdpea.report.cost import WITHOUT_NORMALS
    from hdpea.surface.surface import MIN_POINTS

    points = facts.counts["points"]
    if points < MIN_POINTS:
        return f"at least {MIN_POINTS} points"
    cost = f"about {facts.estimated_seconds:.0f} s and {facts.estimated_peak_bytes / 1e9:.1f} GB"
    if not (facts.counts["usable_normals"] and facts.normals_fit):
        cost += f" (up to {WITHOUT_NORMALS * facts.estimated_peak_bytes / 1e9:.1f}, since normals are estimated)"
    if facts.estimated_peak_bytes > resources.bytes():
        return f"{_in_tiles(points, facts.default_vertices, resources)}; in one piece {cost}. {ONE_PIECE}"
    return f"{cost} for {facts.default_vertices:,} vertices, on two idle cores"


def _in_tiles(points: int, vertices: int, resources: Resources) -> str:
    """Return what a cloud of so many points needs in tiles, as many at a time as there is memory for, two at most."""
    from hdpea.options import Options
    from hdpea.report.cost import PEAK_BYTES, TILED_DISK_BYTES, TILED_SECONDS, TILED_WHOLE_BYTES
    from hdpea.tiling.run import Tiling

    tiling = Tiling(Path(), resources.bytes(), jobs=2)
    try:
        tile_points, _ = tiling.sizes(Options(), points)
    except UsageError:
        return "more memory than that, even in tiles"
    jobs = tiling.workers(tile_points, points / vertices)
    each = PEAK_BYTES.of(tile_points, round(tile_points * vertices / points))
    whole = TILED_WHOLE_BYTES.of(points, vertices)
    return (
        f"about {TILED_SECONDS * points:.0f} s in tiles with --jobs {jobs}, {each / 1e9:.1f} GB in each "
        f"process, {whole / 1e9:.1f} GB in the end for the whole mesh{_fewer(whole, resources)}, and "
        f"{TILED_DISK_BYTES * points / 1e9:.1f} GB of the disk, for {vertices:,} vertices"
    )


def _fewer(whole: float, resources: Resources) -> str:
    """Return for how many vertices there is memory in the end, if not for as many as take `whole` bytes."""
    from hdpea.report.cost import tiled_vertices_within

    memory = resources.bytes()
    thousands = tiled_vertices_within(memory) // 1000
    return f" ({memory / 1e9:.1f} GB with --vertices {thousands}000)" if whole > memory and thousands else ""
