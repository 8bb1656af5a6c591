# SPDX-License-Identifier: GPL-3.0-or-later
"""Ground truth: points of known surfaces, with their true embedding, curvature and normals.

>>> from hdpea.dataset import Dataset  # doctest: +SKIP
>>> for sample in Dataset("samples"): ...  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from hdpea.runtime.lazy import lazy_names

if TYPE_CHECKING:
    from hdpea.dataset.build import build_dataset as build_dataset
    from hdpea.dataset.degradation import degraded as degraded
    from hdpea.dataset.loading import Dataset as Dataset
    from hdpea.dataset.options import DatasetOptions as DatasetOptions
    from hdpea.dataset.options import DegradationOptions as DegradationOptions
    from hdpea.dataset.options import GroundTruthOptions as GroundTruthOptions
    from hdpea.dataset.sample import Sample as Sample
    from hdpea.dataset.sample_file import read_sample as read_sample
    from hdpea.dataset.sample_file import write_sample as write_sample
    from hdpea.dataset.sample_generation import make_sample as make_sample
    from hdpea.dataset.surface_file import read_surface as read_surface

__all__ = [
    "Dataset",
    "DatasetOptions",
    "DegradationOptions",
    "GroundTruthOptions",
    "Sample",
    "build_dataset",
    "degraded",
    "make_sample",
    "read_sample",
    "read_surface",
    "write_sample",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Dataset": "hdpea.dataset.loading",
        "DatasetOptions": "hdpea.dataset.options",
        "DegradationOptions": "hdpea.dataset.options",
        "GroundTruthOptions": "hdpea.dataset.options",
        "Sample": "hdpea.dataset.sample",
        "build_dataset": "hdpea.dataset.build",
        "degraded": "hdpea.dataset.degradation",
        "make_sample": "hdpea.dataset.sample_generation",
        "read_sample": "hdpea.dataset.sample_file",
        "read_surface": "hdpea.dataset.surface_file",
        "write_sample": "hdpea.dataset.sample_file",
    },
)
