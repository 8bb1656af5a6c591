# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the embedding."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options.checked import Checked, option
from hdpea.options.device import check_device, device_option
from hdpea.options.lengths import Length

BENDING_LENGTH = 0.6
"""Default bending length in spacings of the mesh's vertices: shorter, and tangent planes of neighbours disagree."""

CURVATURE_RADIUS = 1.0
"""Default radius, in the same spacings, in which curvature is fitted to the points of a cloud: a little more than the
embedding can follow."""


@dataclass(frozen=True)
class EmbeddingOptions(Checked):
    """How the cloud is embedded in R^8 (``hdpea.embedding``)."""

    embedding: str = option(
        "direct",
        "direct: solved for on this cloud; learned: by a trained network, and fewer rounds",
        choices=("direct", "learned"),
    )
    weights: str | None = option(
        None, "learned: file of the network's weights, as `hdpea train` writes it; default: those shipped with hdpea"
    )
    whole_points: int = option(
        80_000, "learned: clouds of more points are embedded in patches that are joined (PMEI)", minimum=1
    )
    device: str = device_option("the network and the particles are computed")
    curvature_radius: Length | None = option(
        None,
        "direct: radius in which curvature is measured, as 0.02 or 1%; default: from the number of vertices that the "
        "points can show",
    )
    bending_length: Length | None = option(
        None,
        "direct: length below which it does not bend, as 0.02 or 1%; default: from the number of vertices that the "
        "points can show",
    )
    metric_scale: float = option(0.5, "direct: c of the metric s^2 = c |k|: larger stretches more", minimum=0)
    max_stretch: float = option(8.0, "direct: largest stretch of the metric in any direction", minimum=1)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_device(self.device)
        if self.weights is not None and self.embedding != "learned":
            raise UsageError(
                f"The {self.embedding} embedding has no use for weights.", "Give `embedding='learned'` as well."
            )
