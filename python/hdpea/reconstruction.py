# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole program as one function: points of any kind enter, a mesh leaves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from numpy.typing import ArrayLike

from hdpea.embedding import Embedder
from hdpea.errors import core_errors_translated
from hdpea.mesh.texture import require_colors
from hdpea.options import Classes, EmbeddingOptions, Length, Options
from hdpea.options.settings import changed
from hdpea.pipeline import reconstruct_cloud
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.reading.objects import PointsLike
from hdpea.result import Reconstruction
from hdpea.runtime.progress import ProgressCallback
from hdpea.runtime.pytorch import check_pytorch, load_in_background, torch_device
from hdpea.runtime.threads import limited_threads

PHASES = (
    "cleaning",
    "normals",
    "denoising",
    "embedding",
    "particles",
    "meshing",
    "refinement",
    "simplification",
    "remeshing",
    "repair",
    "attributes",
    "texture",
    "levels",
    "measuring",
)
"""The phases that ``progress`` hears of, in order; of denoising only if there is noise, or it is asked for; of
simplification, remeshing, and another refinement after them only if fewer vertices are wanted than particles are
spread; of attributes, texture and levels only if there are any."""


def reconstruct(
    points: PointsLike,
    normals: ArrayLike | None = None,
    options: Options | None = None,
    progress: ProgressCallback | None = None,
    sensors: ArrayLike | None = None,
    embedder: Embedder | None = None,
    *,
    vertices: int | None = None,
    faces: int | None = None,
    error: Length | str | float | None = None,
    watertight: bool | None = None,
    fill_holes: Length | str | float | None = None,
    orient: str | None = None,
    denoise: str | None = None,
    embedding: str | None = None,
    seed: int | None = None,
    threads: int | None = None,
    classes: Iterable[int] | str | None = None,
    texture: int | None = None,
    attributes: Mapping[str, ArrayLike] | None = None,
) -> Reconstruction:
    """Make a compact anisotropic triangle mesh of a point cloud.

    Parameters from `vertices` to `texture` are the common ones among the options, and overrule `options`, where all
    others are.

    Parameters
    ----------
    points
        (n, 3) in any unit and frame, an array or a tensor; what is not finite or occurs twice is dropped. Or a cloud
        that brings its normals and attributes: as ``hdpea.read`` returns it, a cloud or mesh of Open3D, trimesh or
        PyVista, a table with columns x, y and z (a structured array, such as PDAL's, or pandas').
    normals
        (n, 3) of any length and sign; estimated where missing, zero or not finite.
    options
        All stages' options.
    progress
        Called with a phase of ``PHASES`` and the fraction of it done; returning False cancels.
    sensors
        (n, 3), from where each point was seen: decides which side is out unless the normals' own signs do.
    embedder
        An embedding of your own, in place of the one that the options name.
    vertices, faces
        How many are wanted; one of the two. Default: one vertex for every 8 points, fewer if their noise
        hides what these would show.
    error
        As few triangles as keep within this length of the points, both ways: in world units, or text such as ``"1%"``
        of the diagonal. `vertices` or `faces` are then the most there may be.
    watertight
        Whether to close every hole, whatever its size. Default: False.
    fill_holes
        Fill holes up to this size across: a length in world units, or text such as ``"1%"`` of the diagonal.
    orient
        Which side is out: ``"auto"`` (default), ``"wnnc"``, ``"mst"``, ``"file"`` or ``"viewpoint"``.
    denoise
        ``"auto"`` (default), ``"none"`` or ``"mls"``.
    embedding
        ``"direct"`` (default) or ``"learned"``.
    seed
        Of everything random; the same seed gives the same bytes. Default: 0.
    threads
        To use; 0 (default): all cores. The result is the same for any number.
    classes
        Take only the points of these classes: ``[2, 6]`` or ``"2,6"``. Default: all points.
    texture
        Make an image of the colours of the points, of so many pixels each way. Default: none.
    attributes
        (n,) or (n, c) by name, of points given as an array: what the vertices are to have, too. Colours are red, green
        and blue, or `colors` (n, 3).

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal, on a line, or hold no triangle.
    UsageError
        If the arrays are not of these shapes, an option is illegal, more vertices are asked for than there are
        points, a viewpoint is asked for and there is none, PyTorch is not installed, or has no such device.
    UnreadableInput
        If no point is finite, or the given normals, or their signs, are insisted on and unusable.
    Interrupted
        If `progress` cancelled.

    Examples
    --------
    >>> import numpy as np
    >>> directions = np.random.default_rng(0).normal(size=(2000, 3))
    >>> sphere = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    >>> mesh = reconstruct(sphere, vertices=200)
    >>> mesh.report.mesh.closed, len(mesh.vertices)
    (True, 200)
    """
    common = {
        "vertices": vertices,
        "faces": faces,
        "error": None if error is None else Length.of(error),
        "watertight": watertight,
        "fill_holes": None if fill_holes is None else Length.of(fill_holes),
        "orient": orient,
        "denoise": denoise,
        "embedding": embedding,
        "seed": seed,
        "threads": threads,
        "classes": None if classes is None else Classes.of(classes),
        "texture": texture,
    }
    given = {name: value for name, value in common.items() if value is not None}
    options = changed(options or Options(), given)
    check_pytorch()
    if options.embedding.device != EmbeddingOptions.device:
        torch_device(options.embedding.device)  # refused now, not when it is needed
    load_in_background()
    with limited_threads(options.threads), core_errors_translated():
        cloud = cleaned_cloud(points, normals, sensors, attributes)
        if options.texture is not None:
            require_colors(cloud.attributes)
        return reconstruct_cloud(cloud, options, progress, embedder)
