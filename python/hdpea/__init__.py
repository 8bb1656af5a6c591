# SPDX-License-Identifier: GPL-3.0-or-later
"""Compact anisotropic triangle meshes from raw point clouds.

>>> from hdpea import reconstruct  # doctest: +SKIP
>>> mesh = reconstruct(points)  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from hdpea.runtime.lazy import lazy_names

if TYPE_CHECKING:
    from hdpea.curvature.estimation import estimate_curvature as estimate_curvature
    from hdpea.curvature.options import CurvatureOptions as CurvatureOptions
    from hdpea.curvature.tensors import CurvatureTensors as CurvatureTensors
    from hdpea.embedding import Embedding as Embedding
    from hdpea.embedding import embed_points as embed_points
    from hdpea.options.reconstruction import Options as Options
    from hdpea.reading import read as read
    from hdpea.reading import read_points as read_points
    from hdpea.reconstruction import reconstruct as reconstruct
    from hdpea.result import Reconstruction as Reconstruction
    from hdpea.writing.meshes import write_mesh as write_mesh

__all__ = [
    "CurvatureOptions",
    "CurvatureTensors",
    "Embedding",
    "Options",
    "Reconstruction",
    "embed_points",
    "estimate_curvature",
    "read",
    "read_points",
    "reconstruct",
    "write_mesh",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "CurvatureOptions": "hdpea.curvature.options",
        "CurvatureTensors": "hdpea.curvature.tensors",
        "Embedding": "hdpea.embedding",
        "Options": "hdpea.options",
        "Reconstruction": "hdpea.result",
        "embed_points": "hdpea.embedding",
        "estimate_curvature": "hdpea.curvature.estimation",
        "read": "hdpea.reading",
        "read_points": "hdpea.reading",
        "reconstruct": "hdpea.reconstruction",
        "write_mesh": "hdpea.writing.meshes",
    },
)
