# SPDX-License-Identifier: GPL-3.0-or-later
"""The point cloud as it comes out of a file, and what is dropped; formats are listed in ``hdpea.reading.formats``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.errors import UnreadableInput, UsageError
from hdpea.reading.names import DEGREES, NORMAL_NAMES, coordinates_among, plain_name
from hdpea.reading.objects import as_array

SENSOR_NAMES = ("sensor_x", "sensor_y", "sensor_z")

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


def _rows(array: ArrayLike, name: str) -> NDArray[np.float64]:
    try:
        rows = as_array(array).astype(np.float64)
    except (TypeError, ValueError) as error:
        raise UsageError(f"The {name} are not numbers: {error}.", f"Give {name} as an (n, 3) array.") from error
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise UsageError(f"The {name} have shape {rows.shape}.", f"Give {name} as an (n, 3) array.")
    return rows
