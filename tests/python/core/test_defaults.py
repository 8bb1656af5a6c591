# SPDX-License-Identifier: GPL-3.0-or-later
"""A default that stands in the core and in Python is one number."""

from __future__ import annotations

import pytest

from hdpea import _core
from hdpea.curvature.options import JET_NEIGHBORS
from hdpea.options import EmbeddingOptions, MeshingOptions, RefinementOptions

IN_PYTHON = {
    ("EmbeddingOptions", "metric_scale"): EmbeddingOptions().metric_scale,
    ("EmbeddingOptions", "max_stretch"): EmbeddingOptions().max_stretch,
    ("ExtractionOptions", "min_component_faces"): MeshingOptions().min_component,
    ("JetOptions", "least_neighbors"): JET_NEIGHBORS,
    ("RefinementOptions", "rounds"): RefinementOptions().rounds,
}
OF_THE_CORE = {
    ("EmbeddingOptions", "bending_length"),  # always set, from the spacing of the particles
    ("EmbeddingOptions", "iterations"),
    ("ExtractionOptions", "max_circumradius"),  # read only, for tiles
    ("JetOptions", "curvature_error"),
    ("JetOptions", "direction_error"),
    ("MeshBudget", "faces"),
    ("MeshBudget", "vertices"),
    ("RefinementOptions", "within_error"),  # makes the options of an error
    ("RemeshingOptions", "edge_length"),
    ("WnncOptions", "spacings_wide"),
}


def bound_options() -> set[tuple[str, str]]:
    owners = [name for name in dir(_core) if name.endswith(("Options", "Budget"))]
    return {(name, field) for name in owners for field in vars(getattr(_core, name)) if not field.startswith("_")}


def test_every_option_of_the_core_is_known_here() -> None:
    assert bound_options() == set(IN_PYTHON) | OF_THE_CORE


@pytest.mark.parametrize(("owner", "field"), sorted(IN_PYTHON))
def test_the_core_has_the_default_of_python(owner: str, field: str) -> None:
    assert getattr(getattr(_core, owner)(), field) == IN_PYTHON[owner, field]
