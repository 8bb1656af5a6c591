# SPDX-License-Identifier: GPL-3.0-or-later
"""The direct embedding has the metric of the learned one if it is given its numbers, as docs/method.md says how."""

from __future__ import annotations

import numpy as np
from helpers import clouds

from hdpea import CurvatureOptions, CurvatureTensors, estimate_curvature
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import EmbeddingOptions

IN_SPACINGS, MAX_STRETCH = 40, 6
"""Of the included weights."""


def test_one_metric_for_both_embeddings() -> None:
    points, normals = clouds.ellipsoid(2000)

    def tensors(options: EmbeddingOptions) -> CurvatureTensors:
        return estimate_curvature(points, normals, CurvatureOptions(embedding=options))

    learned = tensors(EmbeddingOptions(embedding="learned"))
    (spacing,) = [float(each.value) for each in learned.choices if each.name == "metric_spacing"]
    scale = IN_SPACINGS * spacing / UnitFrame.around(points).diagonal
    same = tensors(EmbeddingOptions(metric_scale=scale, max_stretch=MAX_STRETCH)).stretches / learned.stretches
    assert abs(np.percentile(same, [10, 90]) - 1).max() < 0.02
    assert np.median(tensors(EmbeddingOptions()).stretches / learned.stretches) < 0.8
