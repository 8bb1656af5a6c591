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
    facts, resources = _facts(source, classes), Resources(memory)
    click.echo(_as_json(facts, resources) if as_json else _describe(facts, resources))


def _facts(source: str, classes: Classes | None) -> CloudFacts:
    from hdpea.frontend.classes import of_classes
    from hdpea.reading import read_points
    from hdpea.reading.streaming import stream_of
    from hdpea.report.inspection import inspect
    from hdpea.report.sampling import MOST_WHOLE, inspect_stream

    stream = stream_of(Path(source))
    if stream is None or stream.count <= MOST_WHOLE:
        cloud = read_points(source)
        return inspect(cloud if classes is None else of_classes(cloud, classes))
    return inspect_stream(stream, classes)


def _as_json(facts: CloudFacts, resources: Resources) -> str:
    from hdpea.cli.needs import InTiles

    tiled = InTiles.of(facts, resources) if InTiles.needed(facts, resources) else None
    return json.dumps({**asdict(facts), "in_tiles": None if tiled is None else asdict(tiled)}, indent=2)


def _describe(facts: CloudFacts, resources: Resources) -> str:
    from hdpea.cli.needs import needs
    from hdpea.cli.reconstruct import command as reconstruct

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
        "a run needs": needs(facts, resources),
    }
    notes = map(reconstruct.in_flags, facts.notes)
    return "\n".join([*(f"{name:<12}{value}" for name, value in rows.items() if value), *notes])


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
