# SPDX-License-Identifier: GPL-3.0-or-later
"""The curvature metric: how much it stretches, and the lengths at which an embedding is solved for under it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.options.embedding import BENDING_LENGTH, CURVATURE_RADIUS

LARGEST = 1e9
"""No number of a metric that is read from a file may be larger."""


@dataclass(frozen=True)
class Metric:
    """How much curvature stretches lengths: s^2 = clamp(c |k|, 1, s_max^2) along each principal direction.

    The core's solver applies the same formula: ``metric_excess`` in src/hdpea_cpp/embedding/embedding.cpp.

    Attributes
    ----------
    scale
        c, a length, > 0.
    max_stretch
        s_max, at least 1.
    """

    scale: float
    max_stretch: float

    @property
    def curvature_range(self) -> tuple[float, float]:
        """The |k| between which the metric changes with curvature, in 1 / unit of ``scale``."""
        return 1 / self.scale, self.max_stretch**2 / self.scale

    def stretches(self, curvatures: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the stretches of curvatures in 1 / unit of ``scale``, of any sign and shape."""
        wide = np.asarray(curvatures, np.float64)
        return np.asarray(np.sqrt(np.clip(self.scale * np.abs(wide), 1, self.max_stretch**2)))

    def curvatures(self, stretches: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the |k| of stretches in 1 / unit of ``scale``; at an end of the range it may be less, or more."""
        return np.asarray(np.clip(stretches**2, 1, self.max_stretch**2) / self.scale)


@dataclass(frozen=True)
class ScaledMetric(Metric):
    """A metric with the lengths at which an embedding is solved for, all in one unit.

    Where a mesh of any surface is meant, the unit is the spacing of its vertices, sqrt(area / vertices): what a mesh
    can show depends on it. ``at`` gives the metric of one surface.

    Attributes
    ----------
    bending_length
        Below this length the embedding does not bend, >= 0.
    curvature_radius
        Radius in which the principal curvatures are fitted, > 0.
    """

    bending_length: float = BENDING_LENGTH
    curvature_radius: float = CURVATURE_RADIUS

    def at(self, spacing: float) -> ScaledMetric:
        """Return the metric in the unit in which a spacing is `spacing` long."""
        return ScaledMetric(
            self.scale * spacing, self.max_stretch, self.bending_length * spacing, self.curvature_radius * spacing
        )

    def of_clouds(self) -> ScaledMetric:
        """Return the metric with the radius in which curvature is fitted to clouds, in spacings."""
        return replace(self, curvature_radius=CURVATURE_RADIUS)

    def solver(self) -> _core.EmbeddingOptions:
        """Return the options of the core's ``solve_embedding`` for points in the same unit."""
        options = _core.EmbeddingOptions()
        options.metric_scale, options.max_stretch = self.scale, self.max_stretch
        options.bending_length = self.bending_length
        return options

    @classmethod
    def of_record(cls, values: object) -> ScaledMetric:
        """Return the metric that a file holds as a mapping of the four numbers by name.

        Raises
        ------
        ValueError
            If it is no such mapping, or a number is not finite or out of range.
        """
        names = [each.name for each in fields(cls)]
        if not isinstance(values, Mapping) or set(values) != set(names):
            raise ValueError(f"a metric has {', '.join(names)}")
        for name, value in values.items():
            least = 1.0 if name == "max_stretch" else 0.0
            number = isinstance(value, int | float) and not isinstance(value, bool)
            # Bounded before it is converted: an integer may be larger than any float. NaN is not within bounds.
            if not number or not least <= value <= LARGEST:
                raise ValueError(f"{name} of the metric is a number from {least:g} to {LARGEST:g}")
        numbers = {name: float(values[name]) for name in names}
        if not numbers["scale"] > 0 or not numbers["curvature_radius"] > 0:
            raise ValueError("scale and curvature_radius of the metric are above 0")
        return cls(**numbers)
