# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals of which some are none: a constant or anything at all, at some points or all of a region."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea.options import NormalOptions
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.surface.contrary_normals import contrary_normals
from hdpea.surface.normals import oriented_surface
from hdpea.surface.preparation import prepare_surface

COUNT = 4000
WHERE = ["region", "random"]
WHAT = ["constant", "anything"]


def unit(vectors: clouds.Array) -> clouds.Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def partly_none(cloud: clouds.Cloud, where: str, what: str) -> tuple[clouds.Array, clouds.Array]:
    """Return normals of which a quarter is replaced, and which (n,) are."""
    points, normals = cloud
    random = np.random.default_rng(3)
    replaced = points[:, 0] > np.quantile(points[:, 0], 0.75) if where == "region" else random.random(COUNT) < 0.25
    by = unit(random.normal(size=(COUNT, 3))) if what == "anything" else np.tile([0.9, 0.3, 0.1**0.5], (COUNT, 1))
    return np.where(replaced[:, None], by, normals), replaced


@pytest.mark.parametrize("what", WHAT)
@pytest.mark.parametrize("where", WHERE)
@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_they_are_refused_and_hardly_any_others(shape: str, where: str, what: str) -> None:
    points, normals = clouds.CLOSED[shape](COUNT)
    given, replaced = partly_none((points, normals), where, what)
    refused = contrary_normals(points, given)
    wrong = replaced & (abs(np.einsum("nc,nc->n", given, normals)) < 0.5)
    assert refused[wrong].mean() > 0.85
    assert refused[~replaced].mean() < 0.1


@pytest.mark.parametrize("degrees", [0, 10, 20, 30])
@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_normals_with_noise_and_of_any_sign_are_kept(shape: str, degrees: float) -> None:
    points, normals = clouds.CLOSED[shape](COUNT)
    random = np.random.default_rng(4)
    noisy = unit(normals + np.tan(np.radians(degrees)) * random.normal(size=points.shape))
    signs = random.choice([-1, 1], (COUNT, 1))
    spacing = np.sqrt(4 * np.pi / COUNT)
    for moved in (points, points + 0.3 * spacing * random.normal(size=points.shape)):
        assert not contrary_normals(moved, signs * noisy).any()


@pytest.mark.parametrize("thick", [0.02, 0.05, 0.1])
def test_normals_of_plates_with_rims_are_kept(thick: float) -> None:
    assert not contrary_normals(*clouds.box(COUNT, (1, 1, thick))).any()


def test_few_points_and_none_with_normals_are_no_matter() -> None:
    points, normals = clouds.sphere(COUNT)
    assert not contrary_normals(points, 0 * normals).any()
    assert not contrary_normals(points[:16], normals[:16]).any()


@pytest.mark.parametrize("what", WHAT)
@pytest.mark.parametrize("where", WHERE)
def test_they_are_estimated_and_point_out(where: str, what: str) -> None:
    points, normals = clouds.torus(COUNT)
    found = oriented_surface(points, partly_none((points, normals), where, what)[0])
    assert found.method == "file"
    assert 0.2 * COUNT < found.refused == found.estimated < 0.3 * COUNT
    assert (np.einsum("nc,nc->n", found.surface.normals, normals) > 0.5).mean() > 0.98


def test_where_they_are_insisted_on_they_are_kept() -> None:
    points, normals = clouds.torus(COUNT)
    given, _ = partly_none((points, normals), "region", "constant")
    assert oriented_surface(points, given, NormalOptions(normals="file")).refused == 0


def test_a_note_says_how_many() -> None:
    points, normals = clouds.torus(COUNT)
    prepared = prepare_surface(cleaned_cloud(points, partly_none((points, normals), "region", "constant")[0]))
    count = f"{prepared.oriented.refused:,}"
    assert prepared.notes == (
        f"{count} of the given normals do not lie across the surface of the points: "
        f"normals of {count} points were estimated.",
    )
