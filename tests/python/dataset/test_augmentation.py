# SPDX-License-Identifier: GPL-3.0-or-later
"""Augmentation: the same surface, turned or mirrored; what does not depend on that stays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helpers import meshes
from helpers.samples import numbered_sample

from hdpea.dataset.augmentation import TRANSFORMS, augmented, random_rotation
from hdpea.dataset.sample import Sample
from hdpea.errors import UsageError

MATRICES = {**TRANSFORMS, "random": random_rotation(0)}
TURNED = ("points", "surface_points", "normals", "direction1", "estimated_normals", "sensors")


def torus() -> Sample:
    sample = numbered_sample(meshes.torus(), 500)
    return replace(sample, estimated_normals=sample.normals)


def test_there_are_ten_different_ones_of_which_three_mirror() -> None:
    assert len({matrix.tobytes() for matrix in TRANSFORMS.values()}) == 10
    mirrors = [name for name, matrix in TRANSFORMS.items() if np.linalg.det(matrix) < 0]
    assert mirrors == ["mirrored_xy", "mirrored_xz", "mirrored_yz"]
    np.testing.assert_array_equal(TRANSFORMS["z_plus_90"] @ [1, 0, 0], [0, 1, 0])


@pytest.mark.parametrize("name", MATRICES)
def test_lengths_and_angles_stay(name: str) -> None:
    sample, other = torus(), augmented(torus(), MATRICES[name])
    for before, after in zip(
        (getattr(sample, each) for each in TURNED), (getattr(other, each) for each in TURNED), strict=True
    ):
        np.testing.assert_allclose(after @ after.T, before @ before.T, atol=1e-5)
    np.testing.assert_array_equal(other.psi, sample.psi)
    np.testing.assert_array_equal(other.curvatures, sample.curvatures)
    np.testing.assert_allclose((other.normals * other.direction1).sum(axis=1), 0, atol=1e-5)


@pytest.mark.parametrize("name", MATRICES)
def test_normals_stay_outward(name: str) -> None:
    other = augmented(numbered_sample(meshes.icosphere(), 500), MATRICES[name])
    assert ((other.points * other.normals).sum(axis=1) > 0).all()


@pytest.mark.parametrize("name", MATRICES)
def test_the_transpose_undoes_it(name: str) -> None:
    back = augmented(augmented(torus(), MATRICES[name]), MATRICES[name].T)
    for each in TURNED:
        np.testing.assert_allclose(getattr(back, each), getattr(torus(), each), atol=1e-6)


def test_what_a_sample_lacks_it_still_lacks() -> None:
    other = augmented(replace(torus(), sensors=None, estimated_normals=None), TRANSFORMS["x_plus_90"])
    assert other.sensors is None
    assert other.estimated_normals is None


def test_random_rotations_are_rotations_by_the_seed() -> None:
    for seed in range(20):
        np.testing.assert_allclose(random_rotation(seed) @ random_rotation(seed).T, np.eye(3), atol=1e-12)
        assert np.linalg.det(random_rotation(seed)) > 0
    assert (random_rotation(1) != random_rotation(2)).any()


@pytest.mark.parametrize("matrix", [2 * np.eye(3), np.eye(4), np.full((3, 3), np.nan)])
def test_other_matrices_are_refused(matrix: np.ndarray) -> None:
    with pytest.raises(UsageError, match="orthogonal"):
        augmented(torus(), matrix)
