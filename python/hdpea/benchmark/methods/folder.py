# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that another program made from the suite's clouds, perhaps on another machine."""

from __future__ import annotations

from pathlib import Path

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.options import FolderOptions
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading.triangle_mesh import read_triangle_mesh


def reconstruct(cloud: Cloud, vertices: int, options: FolderOptions) -> TriangleMesh:
    """Read the mesh of this model, input and size."""
    return read_triangle_mesh(made_elsewhere(options, cloud.model, cloud.given, vertices))


def made_elsewhere(options: FolderOptions, model: str, given: str, vertices: int) -> Path:
    """Return the path where the mesh of a model, input and size is expected."""
    return Path(options.path.format(model=model, input=given, vertices=vertices))
