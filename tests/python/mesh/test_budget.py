# SPDX-License-Identifier: GPL-3.0-or-later
"""More vertices than there are points to spread them on are refused, whatever the points show."""

from __future__ import annotations

import pytest

from hdpea.errors import UsageError
from hdpea.mesh.budget import particles_wanted
from hdpea.options import MeshingOptions, Options, ParticleOptions
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
