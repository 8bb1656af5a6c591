# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans of a mesh by a simulated range sensor, similar to BlenSor (Gschwandtner et al., 2011)."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.raycasting import RayCaster
from hdpea.dataset.sensors import camera_rays, sensor_positions
from hdpea.errors import CannotReconstruct
from hdpea.geometry.sampling import face_normals, points_at

FIRST_RESOLUTION = 64
"""Pixels across of the first pass, from which the resolution that is needed is estimated."""

SURPLUS = 1.3
"""Points seen for every point wanted, so that a random choice among them breaks up the grid of the pixels."""

LARGEST_RESOLUTION = 2048
"""Highest resolution: a model that yields too few points even then is all but invisible."""

LEAST_COSINE = 0.2
"""Smallest cosine between ray and normal in the noise model: noise grows with its inverse, up to this limit."""


@dataclass(frozen=True)
class Scan:
    """Points of a mesh as seen from outside, one row for each; all in the unit frame.

    Attributes
    ----------
    points
        (n, 3) float64, as the sensor measured them: `surface_points` moved along their rays.
    surface_points
        (n, 3) float64: where the rays hit the mesh.
    normals
        (n, 3) float64, unit: normals of the faces hit, which face the sensor.
    faces
        (n,) int64: the faces hit.
    sensors
        (n, 3) float64: positions of the sensor.
    """

    points: NDArray[np.float64]
    surface_points: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.int64]
    sensors: NDArray[np.float64]

    def at(self, rows: NDArray[np.int64]) -> Scan:
        """Return the scan of these points only."""
        return Scan(**{each.name: getattr(self, each.name)[rows] for each in fields(self)})


def scan_surface(vertices: NDArray[np.float64], faces: NDArray[np.int64], options: ScanOptions | None = None) -> Scan:
    """Scan a mesh (v, 3), (f, 3) in its unit frame, whose faces are oriented outward; the same for the same seed.

    Whatever no ray reaches is missing: cavities, deep pockets, the underside on a turntable. A face hit from behind
    returns nothing, since the sensor is outside. The resolution is chosen so that somewhat more points than wanted
    are seen; those that are kept are chosen at random.

    Raises
    ------
    UsageError
        If embreex is not installed.
    CannotReconstruct
        If the sensor sees nothing, or too little of the mesh.
    """
    options = options or ScanOptions()
    rng = np.random.default_rng(options.seed)
    scanner = _Scanner(vertices, faces, options, rng)
    resolution = FIRST_RESOLUTION
    scan = scanner.look(resolution)
    while len(scan.points) < options.points:
        finer = (SURPLUS * options.points / max(len(scan.points), 1)) ** 0.5
        resolution = max(int(resolution * finer), resolution + 1)
        if not len(scan.points) or resolution > LARGEST_RESOLUTION:
            raise CannotReconstruct(
                "The sensor sees too little of the mesh.", "Do its faces look outward? If so, ask for fewer points."
            )
        scan = scanner.look(resolution)
    return scan.at(np.sort(rng.choice(len(scan.points), options.points, replace=False)))


class _Scanner:
    """A mesh and the places from which it is looked at."""

    def __init__(
        self,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int64],
        options: ScanOptions,
        rng: np.random.Generator,
    ) -> None:
        self._vertices, self._faces, self._options, self._rng = vertices, faces, options, rng
        self._normals, _ = face_normals(vertices, faces)
        self._caster = RayCaster(vertices, faces)
        self._positions = sensor_positions(options, rng)

    def look(self, resolution: int) -> Scan:
        """Return the points that all views together see, each with so many pixels across."""
        views = [self._look_from(position, resolution) for position in self._positions]
        names = (each.name for each in fields(Scan))
        return Scan(**{name: np.concatenate([getattr(view, name) for view in views]) for name in names})

    def _look_from(self, position: NDArray[np.float64], resolution: int) -> Scan:
        rays = camera_rays(position, resolution, roll=2 * np.pi * self._rng.random())
        hits = self._caster.cast(position, rays)
        rays, normals = rays[hits.rays], self._normals[hits.faces]
        on_surface = points_at(self._vertices, self._faces[hits.faces], hits.barycentric)
        cosines = -(normals * rays).sum(axis=1)
        noise = self._range_noise(np.linalg.norm(on_surface - position, axis=1), cosines)
        sensors = np.broadcast_to(position, rays.shape)
        seen = Scan(on_surface + noise[:, None] * rays, on_surface, normals, hits.faces, sensors)
        return seen.at(np.flatnonzero(self._returns(cosines)))

    def _range_noise(self, ranges: NDArray[np.float64], cosines: NDArray[np.float64]) -> NDArray[np.float64]:
        # Quadratic in the range as of depth cameras (Khoshelham and Elberink, 2012), and with the inverse cosine
        # of the angle of incidence as of laser scanners (Soudarissanane et al., 2011).
        farther = (ranges / self._options.distance) ** 2
        std = self._options.noise * farther / np.maximum(cosines, LEAST_COSINE)
        return std * self._rng.standard_normal(len(std))

    def _returns(self, cosines: NDArray[np.float64]) -> NDArray[np.bool_]:
        fading = np.cos(np.radians(self._options.grazing))
        returns: NDArray[np.bool_] = (cosines > 0) & (cosines >= fading * self._rng.random(len(cosines)))
        return returns
