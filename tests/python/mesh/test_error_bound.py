# SPDX-License-Identifier: GPL-3.0-or-later
"""As few triangles as keep an error: checked by distances that share no code with the bound."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from helpers import clouds
from helpers.fuzzing.distances import to_triangles
from helpers.reconstructions import assert_same_bytes
from scipy.spatial import cKDTree

from hdpea import Reconstruction, reconstruct
from hdpea.errors import UsageError
from hdpea.geometry.sampling import sample_surface
from hdpea.mesh.error_bound import ErrorBound
from hdpea.mesh.extraction import Mesh
from hdpea.options import Length, MeshingOptions
from hdpea.surface.normals import oriented_surface
from hdpea.surface.surface import disk_radii

SHAPES = {"cube": clouds.box, "plane": clouds.plane, "sphere": clouds.sphere}
COUNT = 2500


@cache
def made(shape: str, error: str) -> Reconstruction:
    return reconstruct(*SHAPES[shape](COUNT), error=error)


def diagonal(points: clouds.Array) -> float:
    return float(np.linalg.norm(np.ptp(points, axis=0)))


@pytest.mark.parametrize(("shape", "percent"), [("cube", 0.5), ("plane", 0.5), ("sphere", 2), ("sphere", 0.5)])
def test_the_error_is_kept_both_ways(shape: str, percent: float) -> None:
    points, normals = SHAPES[shape](COUNT)
    mesh = made(shape, f"{percent}%")
    error = 1.001 * percent / 100 * diagonal(points)
    assert mesh.report.missed == []
    assert to_triangles(points, mesh.vertices[mesh.faces]).max() <= error
    places = sample_surface(mesh.vertices, mesh.faces, 3000).points
    nearest = cKDTree(points).query(places, 12)[1]
    heights = np.einsum("pkc,pkc->pk", places[:, None] - points[nearest], normals[nearest])
    assert np.abs(heights).min(axis=1).max() <= error


def test_what_is_flat_is_cheap() -> None:
    assert len(made("plane", "0.5%").faces) == 2
    assert len(made("cube", "0.5%").faces) <= 16
    corners = np.array(np.meshgrid(*[[-0.5, 0.5]] * 3)).reshape(3, 8).T
    spacing = (6 / COUNT) ** 0.5
    assert cKDTree(made("cube", "0.5%").vertices).query(corners)[0].max() < spacing / 4


def test_a_larger_error_takes_fewer_triangles() -> None:
    counts = [len(made("sphere", error).faces) for error in ("0.5%", "2%", "8%")]
    assert counts == sorted(counts, reverse=True)
    assert len(set(counts)) == 3


def test_the_farthest_place_is_the_farthest_of_all() -> None:
    points, normals = clouds.box(COUNT)
    surface, made_of_few = oriented_surface(points, normals).surface, reconstruct(points, normals, vertices=60)
    vertices, faces = surface.frame.to_unit(made_of_few.vertices), made_of_few.faces
    places = np.vstack([vertices, sample_surface(vertices, faces, 3000).points])
    nearest = cKDTree(surface.points_in_unit).query(places, 24)[1]
    offsets = places[:, None] - surface.points_in_unit[nearest]
    heights = (offsets * surface.normals[nearest]).sum(axis=2)
    aside = np.sqrt(np.maximum((offsets**2).sum(axis=2) - heights**2, 0))
    beyond = np.maximum(aside - disk_radii(surface.points_in_unit, surface.neighbors)[nearest], 0)
    reached = ErrorBound(surface, 0.0).reached(Mesh(vertices, faces, vertices), places=3000)
    assert reached.mesh_to_points == pytest.approx(np.sqrt(heights**2 + beyond**2).min(axis=1).max())


def test_it_does_not_depend_on_the_frame() -> None:
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    points, normals = clouds.sphere(COUNT)
    turned = reconstruct(1000 * points @ turn.T + 50, normals @ turn.T * np.linalg.det(turn), error="2%")
    assert turned.report.missed == []
    assert len(turned.faces) == pytest.approx(len(made("sphere", "2%").faces), rel=0.15)


def test_a_length_is_as_good_as_a_share() -> None:
    points, normals = clouds.sphere(COUNT)
    in_world = reconstruct(points, normals, error=0.02 * diagonal(points))
    assert_same_bytes(in_world, made("sphere", "2%"))


def test_a_number_caps_it_and_the_error_is_missed() -> None:
    capped = reconstruct(*clouds.sphere(COUNT), error="0.5%", vertices=30)
    assert len(capped.vertices) == 30
    assert "farther than the error of" in capped.report.missed[0]
    wide = reconstruct(*clouds.sphere(COUNT), error="2%", vertices=250)
    assert_same_bytes(wide, made("sphere", "2%"))
    assert wide.report.missed == []


def test_what_points_do_not_allow_is_missed() -> None:
    points, normals = clouds.sphere(800)
    noisy = points + np.random.default_rng(1).normal(0, 0.05, (800, 1)) * normals
    report = reconstruct(noisy, normals, error="0.1%", denoise="none").report
    assert report.error.larger > report.error.asked  # type: ignore[operator]  # an error was asked for
    assert any("farther than the error of" in each for each in report.missed)


def test_a_number_alone_tells_the_error_that_it_reaches() -> None:
    few, many = (reconstruct(*clouds.sphere(COUNT), vertices=count).report.error for count in (60, 400))
    assert few.asked is None
    assert 0 < many.larger < few.larger


def test_no_error_at_all_is_refused() -> None:
    with pytest.raises(UsageError, match="`error` of 0"):
        MeshingOptions(error=Length(0))
