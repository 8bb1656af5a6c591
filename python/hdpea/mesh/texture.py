# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours finer than the triangles: an image of what the points say, laid on the mesh."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError, core_errors_translated
from hdpea.geometry.color import linear_of_srgb, srgb_of_linear
from hdpea.geometry.interpolation import Interpolation
from hdpea.geometry.rasterizing import covered_pixels
from hdpea.geometry.texture import Texture
from hdpea.geometry.triangles import vertex_normals
from hdpea.mesh.extraction import Mesh
from hdpea.reading.attributes import Attributes, split_colors
from hdpea.surface.surface import Surface

GUTTER = 4
"""Pixels around each chart that have its colours, too: what filters and smaller copies of the image reach for."""

PIXELS_AT_ONCE = 200_000
"""Pixels that are interpolated at a time: about 200 MB."""


def check_texturing() -> None:
    """Make sure that a texture can be made here.

    Raises
    ------
    UsageError
        If xatlas or Pillow is missing.
    """
    missing = [name for name in ("xatlas", "PIL") if find_spec(name) is None]
    if missing:
        raise UsageError(
            f"Cannot make a texture: there is no {' and no '.join(missing)}.", "pip install 'hdpea[texture]'"
        )


def require_colors(attributes: Attributes) -> None:
    """Make sure that a texture can be made of points, before anything else is.

    Raises
    ------
    UsageError
        If they have no colours, or a library is missing.
    """
    check_texturing()
    if split_colors(attributes)[0] is None:
        named = ", ".join(attributes) or "none"
        raise UsageError(f"A `texture` is asked for, but the points have no colours (attributes: {named}).")


def texture_of(mesh: Mesh, surface: Surface, colors: NDArray[np.float64], size: int) -> Texture:
    """Cut the mesh into charts (xatlas), and colour their pixels by the points.

    The colour of a pixel is the affine fit to its nearest points of the same sheet (``hdpea.geometry.interpolation``),
    of light, not of sRGB.

    Parameters
    ----------
    mesh
        Faces oriented as the normals of the surface.
    colors
        (n, 3) of the points of `surface`, sRGB from 0 to 1; NaN where unknown.
    size
        Width and height of the image, in pixels.

    Raises
    ------
    UsageError
        If xatlas or Pillow is missing.
    """
    check_texturing()
    vertices, corners, places = _charts(mesh, size)
    covered = covered_pixels(size * places[corners], size, size)
    at_corners = mesh.faces[covered.triangles]
    points = np.einsum("mk,mkc->mc", covered.barycentric, mesh.vertices_in_unit[at_corners])
    normals = vertex_normals(mesh.vertices_in_unit, mesh.faces)
    normals = np.einsum("mk,mkc->mc", covered.barycentric, normals[at_corners])
    light = _light_at(points, normals, surface, colors)
    image = np.zeros((size * size, 3), np.uint8)
    image[covered.pixels] = np.rint(255 * srgb_of_linear(light))
    is_covered = np.zeros(size * size, bool)
    is_covered[covered.pixels] = True
    filled = _with_gutters(image.reshape(size, size, 3), is_covered.reshape(size, size))
    return Texture(filled, places, corners, vertices)


def _charts(mesh: Mesh, size: int) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Return the vertex of each place, the places of the corners of the faces, and the places (t, 2)."""
    import xatlas

    atlas, packing = xatlas.Atlas(), xatlas.PackOptions()
    packing.resolution, packing.padding = size, 2 * GUTTER
    atlas.add_mesh(mesh.vertices_in_unit.astype(np.float32), mesh.faces.astype(np.uint32))
    atlas.generate(pack_options=packing)
    vertices, corners, places = atlas[0]
    # It is not as large as was asked for, and no square.
    extent = np.array([atlas.width, atlas.height], np.float64)
    return vertices.astype(np.int64), corners.astype(np.int64), places * extent / extent.max()


def _light_at(
    points: NDArray[np.float64], normals: NDArray[np.float64], surface: Surface, colors: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the linear light (m, 3), from 0 to 1, at points of the mesh."""
    known = np.asarray(np.isfinite(colors).all(axis=1))
    given = linear_of_srgb(np.where(known[:, None], colors, 0))
    light = np.empty_like(points)
    with core_errors_translated():
        for start in range(0, len(points), PIXELS_AT_ONCE):
            rows = slice(start, start + PIXELS_AT_ONCE)
            fit = Interpolation.of(surface.points_in_unit, surface.normals, points[rows], normals[rows], known)
            light[rows] = fit(given)
    # Where no near point has a colour, the mean of those that have.
    return np.where(np.isfinite(light), light, given[known].mean(axis=0) if known.any() else 0).clip(0, 1)


def _with_gutters(image: NDArray[np.uint8], covered: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Give pixels near covered ones the colour of one of these, and the others the mean colour."""
    if not covered.any():
        return image
    mean = np.rint(image[covered].mean(axis=0)).astype(np.uint8)
    for _ in range(GUTTER):
        # Images repeat, so what is beside the border is on the other side.
        before = covered.copy()
        for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
            beside = np.roll(before, step, axis) & ~covered
            image[beside] = np.roll(image, step, axis)[beside]
            covered |= beside
    image[~covered] = mean
    return image
