# SPDX-License-Identifier: GPL-3.0-or-later
"""Positions as users give them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Position:
    """A point in world units.

    Raises
    ------
    ValueError
        If a coordinate is not finite.
    """

    x: float
    y: float
    z: float

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, (self.x, self.y, self.z))):
            raise ValueError(f"a position cannot be {self}: its coordinates are finite")

    @classmethod
    def parse(cls, text: str) -> Position:
        """Read ``1,2.5,-3``; ValueError if it is no position."""
        try:
            x, y, z = map(float, text.split(","))
        except ValueError:
            raise ValueError(f"{text!r} is not a position such as 1,2.5,-3") from None
        return cls(x, y, z)

    def as_array(self) -> NDArray[np.float64]:
        """Return the coordinates, (3,)."""
        import numpy as np  # not at the top: the options import this module, and help is to be instant

        return np.array([self.x, self.y, self.z])

    def __str__(self) -> str:
        return ",".join(repr(number).removesuffix(".0") for number in (self.x, self.y, self.z))
