# SPDX-License-Identifier: GPL-3.0-or-later
"""A part of a cloud, by the classes of its points."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.options.classes import Classes
from hdpea.reading.attributes import classes_of
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import PointStream


def of_classes(cloud: PointCloud, classes: Classes) -> PointCloud:
    """Return the points of a cloud that are of one of the classes, and a note of how many they are.

    Raises
    ------
    UsageError
        If the points have no classes, or none has one of these.
    """
    found = _known_classes(cloud)
    rows = np.flatnonzero(np.isin(found, classes.numbers))
    if not len(rows):
        there = ", ".join(map(str, np.unique(found)[:20]))
        raise UsageError(f"No point is of the `classes` {classes}.", f"There are points of the classes {there}.")
    return replace(cloud.at(rows), notes=(*cloud.notes, taken_note(len(rows), len(found), classes)))


def taken_note(taken: int, count: int, classes: Classes) -> str:
    """Return a sentence about how many points are of the classes."""
    return f"Taken: the {taken:,} of {count:,} points that are of the classes {classes}."


def stream_of_classes(stream: PointStream, classes: Classes) -> PointStream:
    """Return the stream of the points of a cloud that are of one of the classes.

    Gone through, it raises what ``of_classes`` does.
    """

    def chunks() -> Iterator[PointCloud]:
        taken = 0
        for chunk in stream.chunks():
            rows = np.flatnonzero(np.isin(_known_classes(chunk), classes.numbers))
            taken += len(rows)
            yield chunk.at(rows)
        if not taken:
            raise UsageError(f"No point is of the `classes` {classes}.", "hdpea info tells which there are.")

    return replace(stream, chunks=chunks)


def _known_classes(cloud: PointCloud) -> NDArray[np.int64]:
    found = classes_of(cloud.attributes)
    if found is None:
        named = ", ".join(cloud.attributes) or "none"
        raise UsageError(f"`classes` is given, but the points have no classification (attributes: {named}).")
    return found
