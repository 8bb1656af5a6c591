# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds as scanners and other programs deliver them, of surfaces that are known."""

from __future__ import annotations

import numpy as np
from helpers.clouds import TAU, Array, sphere_points
from scipy.spatial.transform import Rotation

ELLIPSOID = np.array([1.0, 0.8, 0.6])
ROOM = np.array([[-8.0, -6.0, 0.0], [8.0, 6.0, 3.0]])
"""Lowest and highest corner."""

CLIFF = 20.0


def spacing_of(count: int) -> float:
    """Return the spacing of so many points on the unit sphere."""
    return float(np.sqrt(4 * np.pi / count))


def with_outliers(count: int, outliers: int) -> Array:
    """Return a unit sphere, and points anywhere in a cube of side 3 around it."""
    strewn = np.random.default_rng(2).uniform(-1.5, 1.5, (outliers, 3))
    return np.vstack([sphere_points(count, 1), strewn])


def repeated_rays(count: int, frames: int, noise: float, at_random: bool = False) -> Array:
    """Return frames of a unit sphere along the same rays; the noise of the range is in spacings of a frame."""
    places = np.arange(count)
    polar, around = np.arccos(1 - (2 * places + 1) / count), places * np.pi * (1 + 5**0.5)
    rays = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=1)
    rays = sphere_points(count, 1) if at_random else rays
    random = np.random.default_rng(1)
    return np.vstack([rays * (1 + random.normal(0, noise * spacing_of(count), (count, 1))) for _ in range(frames)])


def noise_by_range(points: Array, least: float, most: float) -> Array:
    """Return points about the origin with spacings of noise every way that grows with the range from (0, 0, 3)."""
    ranges = np.linalg.norm(points - [0, 0, 3], axis=1, keepdims=True)
    noise = least + (most - least) * (ranges - ranges.min()) / np.ptp(ranges)
    return points + spacing_of(len(points)) * noise * np.random.default_rng(1).normal(size=points.shape)


def jittered_copies(count: int, copies: int, jitter: float) -> Array:
    """Return the same points of a unit sphere again and again, each nearly where it was."""
    points = sphere_points(count, 1)
    return np.vstack(
        [points + jitter * np.random.default_rng(seed).normal(size=points.shape) for seed in range(copies)]
    )


def two_scans_of_a_ball(count: int, spacings: float) -> tuple[Array, Array]:
    """Return two scans of a unit sphere, out of register along x, and their true normals."""
    one, other = sphere_points(count, 1), sphere_points(count, 2)
    return np.vstack([one, other + np.array([spacings * spacing_of(count), 0, 0])]), np.vstack([one, other])


def two_scans_of_a_wall(count: int, spacings: float) -> tuple[Array, Array]:
    """Return two scans of a unit square, out of register along z, with a tenth of a spacing of noise; normals +z."""
    random = np.random.default_rng(0)
    spacing = count**-0.5
    layers = [
        np.column_stack([random.random((count, 2)), offset * spacing + 0.1 * spacing * random.normal(size=count)])
        for offset in (0, spacings)
    ]
    return np.vstack(layers), np.tile([0.0, 0.0, 1.0], (2 * count, 1))


def overlapping_strips(count: int, spacings: float) -> Array:
    """Return two strips of a unit square of hills, of so many points each, which overlap in a band, where the second is
    so many spacings too high."""
    random = np.random.default_rng(0)
    spacing = (2 * count / 1.15) ** -0.5
    strips = []
    for low, offset in ((0, 0), (0.425, spacings)):
        x, y = low + 0.575 * random.random(count), random.random(count)
        z = 0.04 * np.sin(12 * x) * np.cos(5 * y) + offset * spacing + 0.1 * spacing * random.normal(size=count)
        strips.append(np.column_stack([x, y, z]))
    return np.vstack(strips)


def turntable(count: int, spacings: float, degrees: float = 400) -> Array:
    """Return an open tube, radius 1 and height 2, scanned all around and further, where it is so many spacings off."""
    random = np.random.default_rng(0)
    turn, height = np.radians(random.uniform(0, degrees, count)), random.uniform(-1, 1, count)
    radius = 1 + spacings * np.sqrt(2 * np.radians(degrees) / count) * turn / TAU
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), height], axis=1)


def rings(rows: int, ratio: float) -> Array:
    """Return circles of latitude of the unit sphere, turned at random, `ratio` times denser along than across."""
    circles = []
    for row in range(rows):
        polar = np.pi * (row + 0.5) / rows
        count = max(3, int(2 * rows * ratio * np.sin(polar)))
        around = np.arange(count) * TAU / count + 6 * np.random.default_rng(row).random()
        ring = np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.full(count, np.cos(polar))
        circles.append(np.stack(ring, axis=1))
    return np.vstack(circles)


def contours(rows: int, of_each: int) -> Array:
    """Return contours of an ellipsoid with half axes 1, 0.7 and 1.2, without its poles."""
    height, around = np.meshgrid(np.linspace(-0.97, 0.97, rows), np.arange(of_each) * TAU / of_each, indexing="ij")
    radius = np.sqrt(1 - height**2)
    on_sphere = np.stack([radius * np.cos(around), radius * np.sin(around), height], axis=-1)
    return on_sphere.reshape(-1, 3) * [1, 0.7, 1.2]


def crossed_profiles(rows: int, ratio: int) -> Array:
    """Return profiles of gentle hills, so many along x and along y and one apart, `ratio` times denser along each."""
    across = np.arange(float(rows))
    along = np.arange((rows - 1) * ratio + 1) / ratio
    x, y = (grid.ravel() for grid in np.meshgrid(along, across))
    both = np.unique(np.concatenate([np.stack([x, y], axis=1), np.stack([y, x], axis=1)]), axis=0)
    return np.column_stack([both, 0.8 * np.sin(both[:, 0] / 4) * np.cos(both[:, 1] / 5)])


def tube_profiles(rows: int, of_each: int) -> Array:
    """Return circles of radius 1, one every 1 along x."""
    along, around = np.meshgrid(np.arange(float(rows)), np.arange(of_each) * TAU / of_each, indexing="ij")
    return np.column_stack([along.ravel(), np.cos(around).ravel(), np.sin(around).ravel()])


def lidar_rays(elevations: Array, step: float) -> Array:
    """Return the directions (n, 3) of beams of these elevations, a pulse every `step`; all in degrees."""
    around, up = np.meshgrid(np.radians(np.arange(0, 360, step)), np.radians(elevations))
    return np.stack([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)], axis=-1).reshape(-1, 3)


def lidar_ground(beams: int, step: float) -> Array:
    """Return one frame of flat ground seen from 1.7 m above it, from 3.6 m to 39 m away, with 1 cm of noise."""
    rays = lidar_rays(-np.linspace(2.5, 25, beams), step)
    ranges = -1.7 / rays[:, 2] + np.random.default_rng(0).normal(0, 0.01, len(rays))
    return ranges[:, None] * rays + [0, 0, 1.7]


def lidar_room(beams: int, step: float) -> Array:
    """Return one frame of a room from 1.2 m above its floor, with 1 cm of noise."""
    rays, sensor = lidar_rays(np.linspace(-15, 15, beams), step), np.array([0, 0, 1.2])
    # A level ray hits neither floor nor ceiling, and one along an axis two walls only.
    steep = np.where(abs(rays) > 1e-12, rays, 1e-12)
    ranges = (np.where(steep > 0, ROOM[1] - sensor, ROOM[0] - sensor) / steep).min(axis=1)
    return sensor + rays * (ranges + np.random.default_rng(0).normal(0, 0.01, len(rays)))[:, None]


def noisy_ground(count: int, noise: float, thick: float = 0) -> Array:
    """Return a flat unit square, or a plate so many spacings thick, with so many spacings of noise every way."""
    random = np.random.default_rng(0)
    places = np.column_stack([random.random((count, 2)), thick * count**-0.5 * random.integers(0, 2, count)])
    return places + noise * count**-0.5 * random.normal(size=(count, 3))


def turned_wall(count: int, on_a_grid: bool, degrees: float) -> Array:
    """Return points of a flat wall, 4 by 3, that is neither level nor upright."""
    rows = round(np.sqrt(count * 3 / 4))
    grid = np.stack(np.meshgrid(np.linspace(0, 4, round(rows * 4 / 3)), np.linspace(0, 3, rows)), axis=-1)
    random = np.random.default_rng(count).uniform(0, [4, 3], (count, 2))
    flat = np.pad(grid.reshape(-1, 2) if on_a_grid else random, ((0, 0), (0, 1)))
    return flat @ Rotation.from_rotvec([np.radians(degrees), 0.2, 0.1]).as_matrix().T


def ball_on_a_floor(count: int) -> Array:
    """Return a unit sphere that lies on a square of side 6, which has twice as many points."""
    floor = np.column_stack([np.random.default_rng(0).uniform(-3, 3, (2 * count, 2)), np.full(2 * count, -1.0)])
    return np.vstack([sphere_points(count, 1), floor])


def land_with_a_cliff(step: float) -> Array:
    """Return a height field, of which a part lies higher by a cliff."""
    u, v = (axis.ravel() for axis in np.meshgrid(np.arange(0, 150, step), np.arange(0, 120, step)))
    plateau = u > 80 + 5 * np.sin(v / 10)
    return np.column_stack([u, v, 5 * np.sin(u / 25) + 3 * np.cos(v / 18) + CLIFF * plateau])


def land_with_trees(count: int) -> Array:
    """Return land, a house with a flat roof, and round trees, below which as many points are of the ground."""
    random = np.random.default_rng(0)
    u, v = random.random((2, count)) * [[100.0], [80.0]]
    land = np.column_stack([u, v, 2 * np.sin(u / 20) + np.cos(v / 15)])
    land[(abs(u - 30) < 12) & (abs(v - 40) < 9), 2] = 12
    spots = np.array([[60, 15], [70, 30], [62, 50], [75, 65], [88, 20], [90, 45], [90, 70], [10, 70], [10, 10]])
    crowns = [
        [x, y, 7] + [6, 6, 4] * sphere_points(200, seed) * random.uniform(0.7, 1, (200, 1))
        for seed, (x, y) in enumerate(spots)
    ]
    shown = [crown[crown[:, 2] > 6] for crown in crowns]
    return np.vstack([land, *shown]) + random.normal(0, 0.03, (count + sum(map(len, shown)), 3))


def box_on_a_table(count: int) -> Array:
    """Return a unit cube without its bottom on a square of side 4, with a fifth of a spacing of noise."""
    random, spacing = np.random.default_rng(0), 4 * count**-0.5
    table = random.uniform(-2, 2, (count, 2))
    parts = [np.column_stack([table, 0 * table[:, 0]])[(abs(table) > 0.5).any(axis=1)]]
    for axis, side in [(0, -0.5), (0, 0.5), (1, -0.5), (1, 0.5), (2, 1.0)]:
        face = random.random((count // 16, 3)) - [0.5, 0.5, 0]
        face[:, axis] = side
        parts.append(face)
    points = np.vstack(parts)
    return points + random.normal(0, 0.2 * spacing, points.shape)


def cables_and_a_pole(count: int, radius: float = 0.01, seed: int = 0) -> Array:
    """Return three sagging cables 20 m long, and a pole of 15 cm, with half as many points again."""
    random, parts = np.random.default_rng(seed), []
    for y in (0, 0.5, 1):
        x, around = 20 * random.random(count), TAU * random.random(count)
        height = 0.02 * (x - 10) ** 2 + 5
        parts.append(np.column_stack([x, y + radius * np.cos(around), height + radius * np.sin(around)]))
    around, height = random.random((2, count * 3 // 2)) * [[TAU], [7]]
    parts.append(np.column_stack([10 + 0.075 * np.cos(around), -1 + 0.075 * np.sin(around), height]))
    return np.vstack(parts)


def lidar_frame(rings: int, turns: int = 500) -> Array:
    """Return what a lidar that turns in the origin, 1.7 above the ground, sees of it, a car and a wall."""
    up, around = np.meshgrid(np.radians(np.linspace(-25, 8, rings)), np.arange(turns) * TAU / turns, indexing="ij")
    rays = np.stack([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)], axis=-1).reshape(-1, 3)
    boxes = ([-80, -80, -3], [80, 80, -1.7]), ([5, -1, -1.7], [9, 1, -0.2]), ([-20, 10, -1.7], [20, 11, 4])
    reached = np.min([_distance_to(np.array(low), np.array(high), rays) for low, high in boxes], axis=0)
    return np.asarray(rays[reached < 60] * reached[reached < 60, None])


def _distance_to(low: Array, high: Array, rays: Array) -> Array:
    """Return how far along rays (n, 3) from the origin a box is, (n,): infinite where they miss it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = np.sort([low / rays, high / rays], axis=0)
    near, far = sides[0].max(axis=1), sides[1].min(axis=1)
    return np.where((near <= far) & (near > 0), near, np.inf)


def table_from_above(count: int) -> Array:
    """Return a table without its underside: a top and four legs, which are seen from the side."""
    random = np.random.default_rng(0)
    places = random.uniform([-0.6, -0.35], [0.6, 0.35], (count * 3 // 4, 2))
    top = np.column_stack([places, np.full(len(places), 0.7)])
    legs = []
    for corner in np.array([[-0.5, -0.25], [0.5, -0.25], [-0.5, 0.25], [0.5, 0.25]]):
        around, height = random.random((2, count // 16)) * [[TAU], [0.64]]
        legs.append(np.column_stack([corner + 0.02 * np.stack([np.cos(around), np.sin(around)], axis=1), height]))
    return np.vstack([top, *legs])


def solid_ball(count: int) -> Array:
    """Return about half as many points that fill the unit ball."""
    points = np.random.default_rng(0).uniform(-1, 1, (count, 3))
    return points[np.linalg.norm(points, axis=1) < 1]


def voxels_of_a_ball(across: int) -> Array:
    """Return the cells of a cubic grid in a ball that is so many of them across."""
    cells = np.stack(np.meshgrid(*[np.arange(across)] * 3), axis=-1).reshape(-1, 3) - (across - 1) / 2
    return cells[np.linalg.norm(cells, axis=1) < across / 2]
