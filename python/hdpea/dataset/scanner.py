# SPDX-License-Identifier: GPL-3.0-or-later
"""A simulated range sensor that looks at a mesh from several places."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.raycasting import RayCaster
from hdpea.dataset.scan import Scan
from hdpea.dataset.scan_faults import Misplacement, at_depth_jumps, flights, misplacements
from hdpea.dataset.sensor_rays import Rays, camera_rays, lidar_rays
from hdpea.dataset.sensors import sensor_positions
from hdpea.geometry.sampling import face_normals, points_at

GROWTH = {"none": 0, "linear": 1, "quadratic": 2}
"""Power of the range with which its noise grows."""

LEAST_COSINE = 0.2
"""Smallest cosine between ray and normal in the noise model: noise grows with its inverse, up to this limit."""


class Scanner:
    """A mesh and the places from which it is looked at."""

    def __init__(
        self,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int64],
        options: ScanOptions,
        rng: np.random.Generator,
        flying: np.random.Generator,
        moves: np.random.Generator,
    ) -> None:
        self._vertices, self._faces, self._options = vertices, faces, options
        self._rng, self._flying = rng, flying
        self._normals, _ = face_normals(vertices, faces)
        self._caster = RayCaster(vertices, faces)
        self._positions = sensor_positions(options, rng)
        self._misplacements = misplacements(options, moves)

    def look(self, resolution: int) -> Scan:
        """Return the points that all views together see, each with so many pixels across."""
        views = [
            self._registered(self._look_from(position, resolution), misplacement)
            for position, misplacement in zip(self._positions, self._misplacements, strict=True)
        ]
        names = (each.name for each in fields(Scan))
        return Scan(**{name: np.concatenate([getattr(view, name) for view in views]) for name in names})

    def _look_from(self, position: NDArray[np.float64], resolution: int) -> Scan:
        rays = self._rays(position, resolution)
        hits = self._caster.cast(position, rays.directions)
        directions, normals = rays.directions[hits.rays], self._normals[hits.faces]
        on_surface = points_at(self._vertices, self._faces[hits.faces], hits.barycentric)
        cosines = -(normals * directions).sum(axis=1)
        ranges = np.linalg.norm(on_surface - position, axis=1)
        errors = self._range_noise(ranges, cosines)
        if self._options.flying:
            jumps = at_depth_jumps(rays, hits.rays, on_surface, normals, ranges)
            errors += flights(jumps, self._options, self._flying)
        sensors = np.broadcast_to(position, directions.shape)
        seen = Scan(on_surface + errors[:, None] * directions, on_surface, normals, hits.faces, sensors)
        return seen.at(np.flatnonzero(self._returns(cosines)))

    def _rays(self, position: NDArray[np.float64], resolution: int) -> Rays:
        if self._options.sensor == "lidar":
            return lidar_rays(position, resolution, self._options.ring_ratio)
        return camera_rays(position, resolution, roll=2 * np.pi * self._rng.random())

    def _registered(self, view: Scan, misplacement: Misplacement) -> Scan:
        if not (self._options.misrotated or self._options.misplaced):
            return view
        return replace(view, points=misplacement.of(view.points), sensors=misplacement.of(view.sensors))

    def _range_noise(self, ranges: NDArray[np.float64], cosines: NDArray[np.float64]) -> NDArray[np.float64]:
        # Quadratic in the range as of depth cameras (Khoshelham and Elberink, 2012), and with the inverse cosine
        # of the angle of incidence as of laser scanners (Soudarissanane et al., 2011).
        farther = (ranges / self._options.distance) ** GROWTH[self._options.noise_growth]
        std = self._options.noise * farther / np.maximum(cosines, LEAST_COSINE)
        return std * self._rng.standard_normal(len(std))

    def _returns(self, cosines: NDArray[np.float64]) -> NDArray[np.bool_]:
        fading = np.cos(np.radians(self._options.grazing))
        returns: NDArray[np.bool_] = (cosines > 0) & (cosines >= fading * self._rng.random(len(cosines)))
        return returns
