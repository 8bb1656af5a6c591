# SPDX-License-Identifier: GPL-3.0-or-later
"""The cloud that a suite gives to a program, as a surface."""

from __future__ import annotations

from pathlib import Path

import click

from hdpea.geometry.unit_frame import UnitFrame
from hdpea.reading import read_points
from hdpea.surface.surface import Surface


def given_surface(points: Path) -> Surface:
    """Read points with normals, which are taken as they are."""
    cloud = read_points(points)
    if cloud.normals is None:
        raise click.UsageError("The points have no normals.")
    frame = UnitFrame.around(cloud.points)
    return Surface.of(frame, frame.to_unit(cloud.points), cloud.normals)
