# SPDX-License-Identifier: GPL-3.0-or-later
"""Simple shapes as truths, and what an evaluation says of a mesh beside them."""

from __future__ import annotations

from functools import cache

import numpy as np
import trimesh
from numpy.typing import NDArray

from hdpea.evaluation.evaluation import evaluate
from hdpea.evaluation.options import EvaluationOptions
from hdpea.evaluation.scores import Evaluation
from hdpea.evaluation.truth import Truth, truth_of_mesh

Array = NDArray[np.float64]
Mesh = tuple[Array, NDArray[np.int64]]

SAMPLES = 40_000
FEW = EvaluationOptions(samples=SAMPLES)


def mesh_of(mesh: trimesh.Trimesh) -> Mesh:
    return np.array(mesh.vertices, np.float64), np.array(mesh.faces, np.int64)


def square(height: float = 0.0, tilt: float = 0.0, width: float = 1.0) -> Mesh:
    """Return a square of side 1, or narrower, tilted by radians about its left side."""
    x, z = width * np.cos(tilt), height + width * np.sin(tilt)
    vertices = np.array([[0, 0, height], [x, 0, z], [x, 1, z], [0, 1, height]])
    return vertices, np.array([[0, 1, 2], [0, 2, 3]])


def box(size: float) -> Mesh:
    return mesh_of(trimesh.creation.box((size, size, size)))


def sphere(subdivisions: int = 4, radius: float = 1.0) -> Mesh:
    return mesh_of(trimesh.creation.icosphere(subdivisions, radius))


TRUTHS = {"square": square, "box": lambda: box(1), "sphere": sphere}


@cache
def truth_of(name: str) -> Truth:
    return truth_of_mesh(*TRUTHS[name](), FEW)


def measured(result: Mesh, truth: str = "square") -> Evaluation:
    return evaluate(*result, truth_of(truth))
