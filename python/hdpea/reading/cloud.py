# SPDX-License-Identifier: GPL-3.0-or-later
"""The point cloud as it comes out of a file, and what is dropped; formats are listed in ``hdpea.reading.formats``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.errors import UnreadableInput, UsageError
from hdpea.reading.names import DEGREES, NORMAL_NAMES, coordinates_among, plain_name
from hdpea.reading.objects import Parts, PointsLike, as_array, parts_of

SENSOR_NAMES = ("sensor_x", "sensor_y", "sensor_z")

UNIT = 1e-15
"""By how much the length of a vector may be off 1 for rounding alone."""

FARTHEST = 1e150
"""Largest coordinate of which the core can square differences."""

_PROJECT = "Project them to lengths: gdaltransform -s_srs EPSG:4326 -t_srs EPSG:32632 < in.txt > out.txt, in your zone."

MESH_NOTE = "The file is a mesh; its vertices are taken as points, its faces are not used."


@dataclass(frozen=True)
class PointCloud:
    """Points in the frame and units of their file, with what the file says about each.

    Attributes
    ----------
    points
        (n, 3) float64; once cleaned: finite and distinct.
    normals
        (n, 3) float64 or None; once cleaned: of length 1, or 0 where unusable, and None if none is usable.
    attributes
        Every other per-point array of the file by name, (n, ...), unchanged.
    format
        The kind of file, for people to read.
    notes
        What a user should know about how the file was understood, in sentences.
    dropped_non_finite, dropped_duplicates
        How many points were thrown out, and why.
    unusable_normals
        How many of the kept points came with a normal that is zero or not finite.
    clean
        Whether it went through ``cleaned``.
    crs
        The coordinate reference system of the points, as WKT or such as EPSG:25832, if the file says one.
    point_index
        (n,) int64: the place of each point among all of its file, or of the arrays, counted from 0; None while they are
        all there, in their order.
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64] | None = None
    attributes: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    format: str = "arrays"
    notes: tuple[str, ...] = ()
    dropped_non_finite: int = 0
    dropped_duplicates: int = 0
    unusable_normals: int = 0
    clean: bool = False
    crs: str | None = None
    point_index: NDArray[np.int64] | None = None

    def sensors(self) -> NDArray[np.float64] | None:
        """Return from where each point was seen, (n, 3), if the file says so: in sensor_x, y and z, or in sensor."""
        if "sensor" in self.attributes:
            array = np.asarray(self.attributes["sensor"])
        elif all(name in self.attributes and self.attributes[name].ndim == 1 for name in SENSOR_NAMES):
            array = np.stack([self.attributes[name] for name in SENSOR_NAMES], axis=1)
        else:
            return None
        is_positions = array.shape == self.points.shape and array.dtype.kind in "fiu"
        return array.astype(np.float64) if is_positions else None

    def places(self) -> NDArray[np.int64]:
        """Return the place of each point (n,) among all of its file, or of the arrays, counted from 0."""
        return np.arange(len(self.points)) if self.point_index is None else self.point_index

    def at(self, rows: NDArray[np.int64]) -> PointCloud:
        """Return the cloud of the points in these rows (m,)."""
        return replace(
            self,
            points=np.ascontiguousarray(self.points[rows]),
            normals=None if self.normals is None else self.normals[rows],
            attributes={name: values[rows] for name, values in self.attributes.items()},
            point_index=self.places()[rows],
        )

    def counts(self) -> dict[str, int]:
        """Return how many points there are, and what was wrong with others, by name."""
        return {
            "points": len(self.points),
            "dropped_non_finite": self.dropped_non_finite,
            "dropped_duplicates": self.dropped_duplicates,
            "usable_normals": 0 if self.normals is None else int(self.normals.any(axis=1).sum()),
            "unusable_normals": self.unusable_normals,
        }


def from_columns(columns: Mapping[str, NDArray[Any]], format: str, notes: Iterable[str] = ()) -> PointCloud:
    """Sort named columns, each (n,), into coordinates, normals and attributes.

    Raises
    ------
    UnreadableInput
        If there is no x, y or z, or they are degrees.
    """
    others = dict(columns)
    by_plain_name: dict[str, str] = {}
    for name in columns:
        by_plain_name.setdefault(plain_name(name), name)

    def take(names: tuple[str, ...]) -> NDArray[np.float64] | None:
        if len(names) < 3 or not all(name in by_plain_name for name in names):
            return None
        taken = [others.pop(by_plain_name[name]) for name in names]
        if any(column.ndim != 1 or column.dtype.kind not in "fiu" for column in taken):
            raise UnreadableInput(f"its {', '.join(names)} are not columns of numbers.", "Save one number in each.")
        return np.stack([column.astype(np.float64) for column in taken], axis=1)

    points = take(coordinates_among(by_plain_name))
    if points is None:
        if len(DEGREES & set(by_plain_name)) > 1:
            raise UnreadableInput("its coordinates are degrees of longitude and latitude.", _PROJECT)
        found = ", ".join(columns) or "none"
        raise UnreadableInput(f"there are no columns x, y and z (found: {found}).", "Rename the columns.")
    normals = next((taken for names in NORMAL_NAMES if (taken := take(names)) is not None), None)
    return PointCloud(points, normals, others, format, tuple(notes))


def from_arrays(
    points: ArrayLike,
    normals: ArrayLike | None = None,
    sensors: ArrayLike | None = None,
    attributes: Mapping[str, ArrayLike] | None = None,
) -> PointCloud:
    """Take a caller's arrays, points, normals and sensor positions, each (n, 3), of any number type.

    Attributes are any other arrays (n, ...) by name.

    Raises
    ------
    UsageError
        If they are not numbers of these shapes.
    """
    found = _rows(points, "points")
    given = None if normals is None else _rows(normals, "normals")
    seen_from = None if sensors is None else _rows(sensors, "sensors")
    for array, name in ((given, "normals"), (seen_from, "sensors")):
        if array is not None and len(array) != len(found):
            raise UsageError(f"There are {len(found)} points but {len(array)} {name}.", "Each point needs its own.")
    others = {name: as_array(values) for name, values in (attributes or {}).items()}
    for name, values in others.items():
        if values.shape[:1] != (len(found),):
            hint = "Each point needs its own."
            raise UsageError(f"There are {len(found)} points, but `attributes` has {name!r} of {values.shape}.", hint)
    return PointCloud(found, given, others if seen_from is None else {**others, "sensor": seen_from})


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


def _rows(array: ArrayLike, name: str) -> NDArray[np.float64]:
    try:
        rows = as_array(array).astype(np.float64)
    except (TypeError, ValueError) as error:
        raise UsageError(f"The {name} are not numbers: {error}.", f"Give {name} as an (n, 3) array.") from error
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise UsageError(f"The {name} have shape {rows.shape}.", f"Give {name} as an (n, 3) array.")
    return rows


def cleaned(cloud: PointCloud) -> PointCloud:
    """Drop and count points that are not finite or occur twice (the first stays); normalise the normals.

    Raises
    ------
    UnreadableInput
        If no point is left, or one is farther away than can be computed with.
    """
    finite = np.flatnonzero(require_points(cloud))
    kept = finite[first_occurrences(cloud.points[finite])]
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
