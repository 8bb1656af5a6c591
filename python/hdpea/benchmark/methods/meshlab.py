# SPDX-License-Identifier: GPL-3.0-or-later
"""Points and meshes to and from MeshLab."""

from __future__ import annotations

from typing import Any

import numpy as np
import pymeshlab

from hdpea.benchmark.methods import Cloud
from hdpea.geometry.triangles import TriangleMesh


def with_points(cloud: Cloud) -> Any:
    """Return a MeshLab document that holds the cloud."""
    document = pymeshlab.MeshSet()
    document.add_mesh(pymeshlab.Mesh(vertex_matrix=cloud.points, v_normals_matrix=cloud.normals))
    return document


def with_mesh(mesh: TriangleMesh) -> Any:
    """Return a MeshLab document that holds the mesh."""
    document = pymeshlab.MeshSet()
    document.add_mesh(pymeshlab.Mesh(vertex_matrix=mesh[0], face_matrix=mesh[1].astype(np.int32)))
    return document


def current_mesh(document: Any) -> TriangleMesh:
    """Return the mesh that a document holds now."""
    mesh = document.current_mesh()
    return np.asarray(mesh.vertex_matrix(), np.float64), np.asarray(mesh.face_matrix(), np.int64)
