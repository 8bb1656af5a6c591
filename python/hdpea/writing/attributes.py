# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes of vertices as the columns that files hold."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.errors import UsageError
from hdpea.geometry.color import RGB

_INT32 = np.iinfo(np.int32)


def columns_of(attributes: Mapping[str, ArrayLike], count: int) -> dict[str, NDArray[Any]]:
    """Return attributes, (v,) or (v, c), as columns (v,) of the types of PLY; those of arrays are numbered from 0.

    Raises
    ------
    UsageError
        If one is no array of numbers for each of `count` vertices, or called as a coordinate is.
    """
    columns: dict[str, NDArray[Any]] = {}
    for name, values in attributes.items():
        array = np.asarray(values)
        if array.dtype.kind not in "fiub" or array.ndim not in {1, 2} or len(array) != count:
            what = f"{array.dtype} of shape {array.shape}"
            hint = f"Attributes are numbers of shape ({count},) or ({count}, c)."
            raise UsageError(f"The attribute {name!r} is {what}, for {count} vertices.", hint)
        word = re.sub(r"\s+", "_", name)  # what PLY separates names by
        if word in {"x", "y", "z"}:
            raise UsageError(f"The attribute {name!r} has the name of a coordinate.", "Call it something else.")
        named = {word: array} if array.ndim == 1 else {f"{word}_{i}": column for i, column in enumerate(array.T)}
        columns |= {each: _of_ply(column) for each, column in named.items()}
    return columns


def _of_ply(values: NDArray[Any]) -> NDArray[Any]:
    """Return a column in a type that PLY has: not of 64 or 16 bits but for double and short, and little-endian."""
    if values.dtype.kind == "b":
        return values.astype(np.uint8)
    if values.dtype.kind == "f":
        return values.astype("<f8" if values.dtype.itemsize >= 8 else "<f4")
    if values.dtype.itemsize < 8:
        return values.astype(values.dtype.newbyteorder("<"))
    fits = values.min(initial=0) >= _INT32.min and values.max(initial=0) <= _INT32.max
    return values.astype("<i4" if fits else "<f8")


def colors_of(columns: Mapping[str, NDArray[Any]]) -> NDArray[np.uint8] | None:
    """Return the colours (v, 3) among columns, if there are any: red, green and blue of 8 bits, sRGB."""
    if not all(name in columns and columns[name].dtype == np.uint8 for name in RGB):
        return None
    return np.stack([columns[name] for name in RGB], axis=1)
