# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of a sample."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import GroundTruthOptions
from hdpea.dataset.quality import isometry_errors, roughness, spacing_of, stretches
from hdpea.dataset.sample import Sample

PERCENTILES = (0, 5, 50, 95, 100)


@dataclass(frozen=True)
class SampleStatistics:
    """Percentiles (0, 5, 50, 95, 100) of quantities at the points, by name, and which optional arrays there are."""

    points: int
    optional: tuple[str, ...]
    ranges: dict[str, NDArray[np.float64]]


def sample_statistics(sample: Sample, options: GroundTruthOptions) -> SampleStatistics:
    """Return the statistics of a sample whose ground truth was made with `options`."""
    spacing = spacing_of(sample, options)
    stretch = stretches(sample.curvatures, options, spacing)
    ranges = {
        "k1": sample.curvatures[:, 0],
        "k2": sample.curvatures[:, 1],
        "stretch along k1": stretch[:, 0],
        "stretch along k2": stretch[:, 1],
        "ratio of the stretches": stretch[:, 0] / stretch[:, 1],
        "isometry error": isometry_errors(sample, options, spacing),
        "roughness": roughness(sample),
        "distance to the surface": np.linalg.norm(sample.points - sample.surface_points, axis=1),
    }
    optional = tuple(name for name in ("estimated_normals", "sensors") if getattr(sample, name) is not None)
    return SampleStatistics(
        len(sample.points), optional, {name: np.percentile(values, PERCENTILES) for name, values in ranges.items()}
    )
