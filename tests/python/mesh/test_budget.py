# SPDX-License-Identifier: GPL-3.0-or-later
"""More vertices than there are points to spread them on are refused, unless they are but the most there may be."""

from __future__ import annotations

from typing import Any

import pytest
from helpers import clouds

from hdpea import reconstruct
from hdpea.errors import UsageError
from hdpea.mesh import assembly
from hdpea.mesh.budget import particles_wanted
from hdpea.options import Length, MeshingOptions, Options, ParticleOptions
from hdpea.options.points_shown import PointsShown

KEPT, SHOWN = 1000, 2000
"""As on scan lines, of whose points half are left out."""


@pytest.mark.parametrize(
    ("options", "what"),
    [
        (Options(meshing=MeshingOptions(vertices=1500)), "1500 vertices"),
        (Options(meshing=MeshingOptions(faces=3000)), "1502 vertices"),
        (Options(particles=ParticleOptions(particles=1500)), "1500 vertices"),
        (Options(meshing=MeshingOptions(vertices=500), particles=ParticleOptions(particles=1500)), "1500 particles"),
    ],
)
def test_more_than_the_points_that_are_left_are_refused(options: Options, what: str) -> None:
    with pytest.raises(UsageError, match=f"{what} were asked for, but there are {KEPT} distinct points"):
        particles_wanted(options, KEPT, PointsShown(SHOWN))


def test_as_many_as_are_left_are_not() -> None:
    assert particles_wanted(Options(meshing=MeshingOptions(vertices=KEPT)), KEPT, PointsShown(SHOWN))[0] == KEPT


def test_unasked_the_number_follows_what_the_points_show() -> None:
    assert particles_wanted(Options(), KEPT, PointsShown(SHOWN))[0] == SHOWN // 3
    assert particles_wanted(Options(), SHOWN // 5, PointsShown(SHOWN))[0] == SHOWN // 5


@pytest.mark.parametrize("most", [{"vertices": 30}, {"vertices": KEPT + 500}, {"faces": 4 * KEPT}])
def test_with_an_error_they_are_those_of_no_size(most: dict[str, int]) -> None:
    error = Length(0.05)
    capped, any_size = (Options(meshing=MeshingOptions(error=error, **each)) for each in (most, {}))
    shown = PointsShown(SHOWN, exact=False)
    assert particles_wanted(capped, KEPT, shown) == particles_wanted(any_size, KEPT, shown)
    assert capped.resolution_of(SHOWN) == any_size.resolution_of(SHOWN)


def test_few_vertices_that_an_error_chose_are_not_too_few() -> None:
    notes = reconstruct(*clouds.sphere(1000), error="8%", vertices=900).report.notes
    assert [note for note in notes if "So few" in note] == []


def test_no_attempt_is_made_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    points, normals = clouds.sphere(200)
    counts = list[int]()

    def noted(coordinates: Any, bases: Any, neighbors: Any, count: int, **others: Any) -> Any:
        counts.append(count)
        return SPREAD(coordinates, bases, neighbors, count // 2, **others)

    monkeypatch.setattr(assembly, "spread_particles", noted)
    reconstruct(points, normals, vertices=len(points))
    assert counts == [len(points)]


SPREAD = assembly.spread_particles
