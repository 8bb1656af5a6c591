# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors in the few lines that people read."""

from __future__ import annotations

import numpy as np

from hdpea.curvature.tensors import CurvatureTensors
from hdpea.report.summary import describe


def summarize(tensors: CurvatureTensors) -> list[str]:
    """Return what was chosen and what came out; a line each."""
    lines = [*map(describe, tensors.choices), *tensors.notes]
    low, high = tensors.curvature_range
    if not tensors.signed:
        lines.append(f"range: |k| from {low:.3g} to {high:.3g}; a value at an end means that or beyond")
    k1, ratio = abs(tensors.curvatures[:, 0]), tensors.stretching_ratio
    if np.isfinite(k1).any():
        lines.append(f"larger curvature: median {np.nanmedian(k1):.3g}, 95% up to {np.nanpercentile(k1, 95):.3g}")
    if np.isfinite(ratio).any():
        lines.append(f"stretching ratio: median {np.nanmedian(ratio):.3g}, 95% up to {np.nanpercentile(ratio, 95):.3g}")
    lines.append(f"directions: determined at {tensors.determined.mean():.0%} of {len(ratio):,} points")
    return lines
