# SPDX-License-Identifier: GPL-3.0-or-later
"""What is dropped of a cloud that was read or given: points that are not finite, or occur twice."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.errors import UnreadableInput, UsageError
from hdpea.reading.cloud import MESH_NOTE, PointCloud, from_arrays, from_columns
from hdpea.reading.copies import first_copies
from hdpea.reading.objects import Parts, PointsLike, parts_of

UNIT = 1e-15
"""By how much the length of a vector may be off 1 for rounding alone."""

FARTHEST = 1e150
"""Largest coordinate of which the core can square differences."""


def cleaned_cloud(
    points: PointsLike,
    normals: ArrayLike | None = None,
    sensors: ArrayLike | None = None,
    attributes: Mapping[str, ArrayLike] | None = None,
) -> PointCloud:
    """Return the cleaned cloud of a cloud, one of another library, or of arrays as ``from_arrays`` takes them.

    Raises
    ------
    UsageError
        If the arrays are not numbers of these shapes, or a cloud comes with arrays beside it.
    UnreadableInput
        If no point is left.
    """
    if isinstance(points, str | PathLike):
        raise UsageError(f"The points are a name, {points}.", "Read the file: hdpea.read(name).")
    parts = None if isinstance(points, PointCloud) else parts_of(points)
    if parts is not None:
        points = _of_parts(parts)
    if not isinstance(points, PointCloud):
        return cleaned(from_arrays(points, normals, sensors, attributes))
    if normals is not None or sensors is not None or attributes is not None:
        raise UsageError("A cloud brings its own normals, sensors and attributes.", "Give the cloud alone, or arrays.")
    return points if points.clean else cleaned(points)


def _of_parts(parts: Parts) -> PointCloud:
    notes = (MESH_NOTE,) if parts.is_mesh else ()
    if not parts.is_table:
        others = dict(parts.arrays)
        return replace(from_arrays(others.pop("points"), others.pop("normals", None), None, others), notes=notes)
    try:
        return from_columns(parts.arrays, "table", notes)
    except UnreadableInput as error:
        raise UsageError(f"The points are a table: {error.message}", "Name its columns x, y and z.") from error


def cleaned(cloud: PointCloud) -> PointCloud:
    """Drop and count points that are not finite or occur twice, but for rounding; normalise the normals.

    Of equal points the first stays.

    Raises
    ------
    UnreadableInput
        If no point is left, or one is farther away than can be computed with.
    """
    finite = np.flatnonzero(require_points(cloud))
    distinct = finite[first_occurrences(cloud.points[finite])]
    kept = distinct[first_copies(cloud.points[distinct])]
    chosen = cloud.at(kept)
    normals = None if chosen.normals is None else unit_or_zero(chosen.normals)
    usable = 0 if normals is None else int(normals.any(axis=1).sum())
    non_finite, duplicates = len(cloud.points) - len(finite), len(finite) - len(kept)
    unusable = 0 if normals is None else len(kept) - usable
    return replace(
        chosen,
        normals=normals if usable else None,
        dropped_non_finite=non_finite,
        dropped_duplicates=duplicates,
        unusable_normals=unusable,
        clean=True,
        notes=cloud.notes + _cleaning_notes(non_finite, duplicates, unusable),
    )


def require_points(cloud: PointCloud) -> NDArray[np.bool_]:
    """Return which points (n,) are finite.

    Raises
    ------
    UnreadableInput
        If none is, there are none, or one is farther away than can be computed with.
    """
    if len(cloud.points) == 0:
        raise UnreadableInput("there are no points in it.", "Check that the export of the points succeeded.")
    finite = np.asarray(np.isfinite(cloud.points).all(axis=1))
    if not finite.any():
        raise UnreadableInput(
            f"none of its {len(cloud.points)} points is finite.", "NaN and infinite points are dropped."
        )
    farthest = float(abs(cloud.points[finite]).max())
    if farthest > FARTHEST:
        told = f"its coordinates reach {farthest:.3g}, where {FARTHEST:.0e} is the most that can be computed with."
        raise UnreadableInput(told, "Give them in a larger unit, and drop numbers that stand for nothing.")
    return finite


def _cleaning_notes(non_finite: int, duplicates: int, unusable: int) -> tuple[str, ...]:
    told = {
        f"Dropped points with NaN or infinite coordinates: {non_finite:,}.": non_finite,
        f"Dropped points that occur twice: {duplicates:,}.": duplicates,
        f"Normals that are zero or not finite, to be estimated: {unusable:,}.": unusable,
    }
    return tuple(note for note, count in told.items() if count)


def first_occurrences(rows: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the ascending indices (m,) of the rows (n, d) that equal no earlier row."""
    order = np.lexsort(rows.T)
    ordered = rows[order]
    # The sort is stable, so the first of each run of equal rows is the first in the file too.
    starts_run = np.ones(len(rows), dtype=bool)
    starts_run[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    return np.sort(order[starts_run])


def unit_or_zero(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the vectors (n, 3) at length 1; those that are zero or not finite become zero.

    Those of length 1 but for rounding, or of a power of 2 times that, keep their digits: what was read, given on as
    arrays, makes the same mesh.
    """
    with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
        lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
        usable = np.isfinite(lengths) & (lengths > 0)
        powers = np.exp2(np.rint(np.log2(lengths)))
        exact = usable & (abs(lengths / powers - 1) < UNIT)
        return np.where(usable, vectors / np.where(exact, powers, lengths), 0.0)
