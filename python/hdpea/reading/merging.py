# SPDX-License-Identifier: GPL-3.0-or-later
"""Several scans of one thing as one cloud."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import SENSOR_NAMES, PointCloud


def merged(clouds: Sequence[PointCloud]) -> PointCloud:
    """Return the points of all clouds, which have one frame and unit, in their order.

    Points of a cloud without normals get zeros, which are none. Attributes, and sensors, are kept where every cloud
    has them; the notes say which are not.

    Raises
    ------
    UnreadableInput
        If they say that they are in different coordinate reference systems.
    """
    systems = list(dict.fromkeys(cloud.crs for cloud in clouds if cloud.crs is not None))
    if len(systems) > 1:
        told = " and ".join(system[:40] for system in systems)
        raise UnreadableInput(f"The scans are in different coordinate reference systems: {told}.", "Project them.")
    normals = None
    if any(cloud.normals is not None for cloud in clouds):
        normals = np.vstack([np.zeros_like(each.points) if each.normals is None else each.normals for each in clouds])
    attributes = [_with_one_sensor(cloud) for cloud in clouds]
    common = [name for name in attributes[0] if all(_alike(name, attributes[0], each) for each in attributes)]
    lost = sorted(set().union(*attributes) - set(common))
    notes = [note for cloud in clouds for note in cloud.notes]
    if lost:
        notes.append(f"Left out, since not every scan has them: {', '.join(lost)}.")
    return PointCloud(
        np.vstack([cloud.points for cloud in clouds]),
        normals,
        {name: np.concatenate([each[name] for each in attributes]) for name in common},
        ", ".join(dict.fromkeys(cloud.format for cloud in clouds)),
        tuple(dict.fromkeys(notes)),
        crs=systems[0] if systems else None,
    )


def _with_one_sensor(cloud: PointCloud) -> dict[str, NDArray[Any]]:
    """Return the attributes of a cloud, with its sensors, if any, as the one attribute ``sensor`` (n, 3)."""
    sensors = cloud.sensors()
    if sensors is None:
        return dict(cloud.attributes)
    others = {name: values for name, values in cloud.attributes.items() if name not in SENSOR_NAMES}
    return others | {"sensor": sensors}


def _alike(name: str, first: dict[str, NDArray[Any]], other: dict[str, NDArray[Any]]) -> bool:
    """Say whether both have numbers of one shape for each point by that name."""
    if name not in other:
        return False
    one, two = first[name], other[name]
    return one.shape[1:] == two.shape[1:] and {one.dtype.kind, two.dtype.kind} <= set("fiub")
