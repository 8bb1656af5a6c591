# SPDX-License-Identifier: GPL-3.0-or-later
"""What the attributes of points mean, whatever their file calls them: colours, labels, where points were seen from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.color import RGB
from hdpea.reading.cloud import SENSOR_NAMES
from hdpea.reading.names import plain_name

Attributes = Mapping[str, NDArray[Any]]
"""Arrays (n, ...) by name."""

COLOR_COLUMNS = (RGB, ("r", "g", "b"), ("diffuse_red", "diffuse_green", "diffuse_blue"))
COLOR_ARRAYS = ("colors", "color", "rgb", "rgba")

FULL_SCALES = (1.0, 255.0, 65535.0)
"""What white is: the least of these that no value exceeds, of which 1 is for floats alone. LAS has room for 16 bits, of
which many programs use 8."""

CLASS_NAMES = ("classification", "class", "label", "labels")

LABEL_NAMES = (*CLASS_NAMES, "return_number", "number_of_returns", "returnnumber", "numberofreturns")
"""Told by name, since text files and some programs hold them as floats."""

QUANTITY_NAMES = ("intensity", "reflectance", "amplitude", "infrared", "nir", "alpha", "scan_angle", "scan_angle_rank")
"""Integers that are measured rather than named."""


def is_label(name: str, values: NDArray[Any]) -> bool:
    """Say whether values name something, so that a mean of them means nothing."""
    if values.dtype.kind == "f":
        return plain_name(name) in LABEL_NAMES
    return plain_name(name) not in QUANTITY_NAMES


def without_sensors(attributes: Attributes) -> dict[str, NDArray[Any]]:
    """Return the numbers (n,) or (n, c) that belong to the surface, not to where it was seen from."""
    return {
        name: values
        for name, values in attributes.items()
        if name not in (*SENSOR_NAMES, "sensor") and values.ndim in {1, 2} and values.dtype.kind in "fiub"
    }


def classes_of(attributes: Attributes) -> NDArray[np.int64] | None:
    """Return the class (n,) of each point, -1 where it is no number, if there are classes."""
    for name, values in attributes.items():
        if plain_name(name) in CLASS_NAMES and values.ndim == 1 and values.dtype.kind in "fiu":
            return np.where(np.isfinite(values), values, -1).astype(np.int64)
    return None


def split_colors(attributes: Attributes) -> tuple[NDArray[np.float64] | None, dict[str, NDArray[Any]]]:
    """Take the colours out of attributes.

    Returns
    -------
    colors, others
        The sRGB colours (n, 3), 0 to 1, of whatever depth they were; None if there are none. The other attributes.
    """
    by_name = {plain_name(name): name for name in attributes}
    for names in COLOR_COLUMNS:
        if all(name in by_name and attributes[by_name[name]].ndim == 1 for name in names):
            taken = [by_name[name] for name in names]
            colors = _scaled(np.stack([attributes[name] for name in taken], axis=1))
            if colors is not None:
                return colors, _without(attributes, taken)
    for name in COLOR_ARRAYS:
        values = attributes[by_name[name]] if name in by_name else np.empty(0)
        if values.ndim == 2 and values.shape[1] in {3, 4}:
            colors = _scaled(values[:, :3])
            if colors is not None:
                return colors, _without(attributes, [by_name[name]])
    return None, dict(attributes)


def _without(attributes: Attributes, names: list[str]) -> dict[str, NDArray[Any]]:
    return {name: values for name, values in attributes.items() if name not in names}


def _scaled(colors: NDArray[Any]) -> NDArray[np.float64] | None:
    """Return colours (n, 3) from 0 to 1; None if they are none."""
    if colors.dtype.kind not in "fiu":
        return None
    finite = colors[np.isfinite(colors)]
    scales = FULL_SCALES[colors.dtype.kind != "f" :]
    scale = next((scale for scale in scales if finite.max(initial=0) <= scale), None)
    return None if scale is None or finite.min(initial=0) < 0 else colors / np.float64(scale)
