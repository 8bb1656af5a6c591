# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser levels of a mesh, each made from the one before."""

from __future__ import annotations

from pathlib import Path

import pytest
from helpers import clouds

from hdpea import Reconstruction, reconstruct
from hdpea.errors import UsageError
from hdpea.options import Length, MeshingOptions, Options

COUNT = 2500


def levels_of(meshing: MeshingOptions) -> Reconstruction:
    return reconstruct(*clouds.torus(COUNT), Options(meshing=meshing))


def test_each_level_has_half_the_faces_of_the_one_before(tmp_path: Path) -> None:
    made = levels_of(MeshingOptions(vertices=200, lod=3))
    assert [len(level.faces) for level in made.levels] == [200, 100]
    assert [level.faces for level in made.report.levels] == [200, 100]
    distances = [made.report.distances.rms, *(level.rms for level in made.report.levels)]
    assert distances == sorted(distances)
    made.write(tmp_path / "mesh.ply")
    assert {path.name for path in tmp_path.glob("*.ply")} == {"mesh.ply", "mesh.lod1.ply", "mesh.lod2.ply"}


def test_each_level_may_be_twice_as_far_off() -> None:
    made = levels_of(MeshingOptions(error=Length(1, percent=True), lod=3))
    asked = made.report.error.asked
    assert asked is not None
    counts = [len(made.faces), *(level.faces for level in made.report.levels)]
    assert counts == sorted(set(counts), reverse=True)
    for number, level in enumerate(made.report.levels, start=1):
        assert level.error <= asked * 2**number * 1.001


def test_one_level_is_the_mesh_alone() -> None:
    assert levels_of(MeshingOptions(vertices=100)).levels == ()


@pytest.mark.parametrize("count", [0, 17])
def test_too_few_or_too_many_levels_are_refused(count: int) -> None:
    with pytest.raises(UsageError, match="lod"):
        MeshingOptions(lod=count)
