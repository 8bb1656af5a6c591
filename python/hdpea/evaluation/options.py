# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of the evaluation."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.options import Checked, option


@dataclass(frozen=True)
class EvaluationOptions(Checked):
    """How densely both surfaces are sampled."""

    samples: int = option(100_000, "points drawn from each surface; more points lower the sampling floor", minimum=1)
    seed: int = option(0, "seed of these points; the same seed gives the same scores", minimum=0)
