# SPDX-License-Identifier: GPL-3.0-or-later
"""Training of the network that predicts the embedding: on crops of the clouds of datasets, resumable to the last bit.

>>> from hdpea.training import PRESETS, train  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from hdpea.runtime.lazy import lazy_names

if TYPE_CHECKING:
    from hdpea.training.loop import train as train
    from hdpea.training.options import PRESETS as PRESETS
    from hdpea.training.options import TrainingOptions as TrainingOptions
    from hdpea.training.validation import validate as validate

__all__ = [
    "PRESETS",
    "TrainingOptions",
    "train",
    "validate",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "PRESETS": "hdpea.training.options",
        "TrainingOptions": "hdpea.training.options",
        "train": "hdpea.training.loop",
        "validate": "hdpea.training.validation",
    },
)
