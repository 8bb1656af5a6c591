# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in a cloud that is too large to look at whole, by a share of its points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hdpea.frontend.classes import stream_of_classes
from hdpea.options.classes import Classes
from hdpea.reading.cleaning import cleaned
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import PointStream
from hdpea.report.cost import PEAK_BYTES, seconds_of_run
from hdpea.report.inspection import CloudFacts, inspect

MOST_WHOLE, SAMPLED = 1_000_000, 200_000
"""Points from which on a cloud that can be streamed is looked at by a sample, and how large that is, about."""


def inspect_stream(stream: PointStream, classes: Classes | None = None) -> CloudFacts:
    """Go through a cloud once, and tell what so many random points of it show; all of them if they are no more.

    Extents are those of all points; counts and spacings are made of the sample's, by what share it is of the cloud.

    Parameters
    ----------
    classes
        The only ones that count; these are counted in a pass of its own, since few of the cloud may be of them.
        Default: all points.

    Raises
    ------
    UsageError
        If the points have no classes, or none has one of these.
    """
    random, count = np.random.default_rng(0), stream.count
    if classes is not None:
        stream = stream_of_classes(stream, classes)
        count = sum(len(chunk.points) for chunk in stream.chunks())
    share = min(SAMPLED / count, 1.0)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    pieces, total = list[PointCloud](), 0
    for chunk in stream.chunks():
        total += len(chunk.points)
        finite = chunk.points[np.isfinite(chunk.points).all(axis=1)]
        if len(finite):
            low, high = np.minimum(low, finite.min(axis=0)), np.maximum(high, finite.max(axis=0))
        pieces.append(chunk.at(np.flatnonzero(random.random(len(chunk.points)) < share)))
    sample = _joined(pieces, stream)
    facts = inspect(cleaned(sample))
    times = total / len(sample.points)
    counts = {name: round(times * count) for name, count in facts.counts.items()}
    vertices = round(times * facts.default_vertices)
    kept = counts["points"] - counts["dropped_strays"] - counts["dropped_on_lines"]
    looked_at = f"By {len(sample.points):,} random points of {total:,}"
    note = f"{looked_at}: counts and spacings are estimates; the lines below are of these."
    notes = facts.notes if share == 1 else [note, *facts.notes]
    return replace(
        facts,
        counts=counts,
        attributes=list(stream.attributes()) or facts.attributes,
        classes=None if facts.classes is None else {each: round(times * n) for each, n in facts.classes.items()},
        low=low.tolist(),
        high=high.tolist(),
        diagonal=float(np.linalg.norm(high - low)),
        spacing=None if facts.spacing is None else facts.spacing / np.sqrt(times),
        surface_spacing=None if facts.surface_spacing is None else facts.surface_spacing / np.sqrt(times),
        default_vertices=vertices,
        estimated_seconds=seconds_of_run(kept, vertices),
        estimated_peak_bytes=PEAK_BYTES.of(kept, vertices),
        notes=notes,
    )


def _joined(pieces: Sequence[PointCloud], stream: PointStream) -> PointCloud:
    """Return the pieces as one cloud, with what all of them have."""
    first = pieces[0]
    normals = None
    if all(each.normals is not None for each in pieces):
        normals = np.concatenate([each.normals for each in pieces if each.normals is not None])
    attributes = {
        name: np.concatenate([each.attributes[name] for each in pieces])
        for name in first.attributes
        if all(name in each.attributes for each in pieces)
    }
    points = np.concatenate([each.points for each in pieces])
    return PointCloud(points, normals, attributes, format=stream.format, crs=stream.crs)
