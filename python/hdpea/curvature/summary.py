# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors in the few lines that people read, and in those that programs do."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from hdpea.curvature.tensors import CurvatureTensors
from hdpea.report.summary import describe


def as_dict(tensors: CurvatureTensors) -> dict[str, Any]:
    """Return what was chosen and what came out, fit for JSON.

    ``curvature_range`` is null where curvatures have signs, and no limits.
    """
    return {
        "choices": [asdict(each) for each in tensors.choices],
        "notes": list(tensors.notes),
        "points": len(tensors.determined),
        "signed": tensors.signed,
        "curvature_range": None if tensors.signed else list(map(float, tensors.curvature_range)),
        "determined": float(tensors.determined.mean()),
    }


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
