# SPDX-License-Identifier: GPL-3.0-or-later
"""A default that stands in the core and in Python is one number."""

from __future__ import annotations

from hdpea import _core
from hdpea.curvature.options import JET_NEIGHBORS
from hdpea.options import EmbeddingOptions, MeshingOptions, RefinementOptions


def test_the_core_has_the_defaults_of_python() -> None:
    embedding, refinement = _core.EmbeddingOptions(), _core.RefinementOptions()
    assert embedding.metric_scale == EmbeddingOptions().metric_scale
    assert embedding.max_stretch == EmbeddingOptions().max_stretch
    assert refinement.rounds == RefinementOptions().rounds
    assert _core.ExtractionOptions().min_component_faces == MeshingOptions().min_component
    assert _core.JetOptions().least_neighbors == JET_NEIGHBORS
