# SPDX-License-Identifier: GPL-3.0-or-later
"""What is usually done with a raw cloud, by Open3D: the meshes that ours are shown beside."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

DEPTH = 8
"""Octree of the Poisson reconstruction: Open3D's default, and about the spacing of tens of thousands of points."""

FAR = 6.0
"""Spacings of the points from the nearest of them at which the surface is trimmed."""


def plain_mesh(points: NDArray[np.float64], faces: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return vertices and at most so many faces for points (n, 3) without normals.

    Statistical outlier removal (20 neighbours, 2 standard deviations), planes fitted to 30 neighbours, a spanning tree
    for the side that is out, screened Poisson reconstruction, trimming, quadric edge collapse.
    """
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    cloud, _ = cloud.remove_statistical_outlier(20, 2.0)
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(30))
    cloud.orient_normals_consistent_tangent_plane(15)
    # With several threads the result would depend on their number.
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=DEPTH, n_threads=1)
    spacing = np.median(cKDTree(points).query(points, 7)[0][:, 6])
    off = cKDTree(np.asarray(cloud.points)).query(np.asarray(mesh.vertices))[0]
    mesh.remove_vertices_by_mask(off > FAR * spacing)
    mesh = mesh.simplify_quadric_decimation(faces)
    mesh.remove_unreferenced_vertices()
    return np.asarray(mesh.vertices), _outward(np.asarray(mesh.vertices), np.asarray(mesh.triangles, dtype=np.int64))


def _outward(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Turn all faces over if they enclose a negative volume: the spanning tree leaves that to chance."""
    first, second, third = (vertices[faces[:, corner]] for corner in range(3))
    volume = (first * np.cross(second, third)).sum()
    return faces if volume >= 0 else faces[:, ::-1]
