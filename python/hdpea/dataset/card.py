# SPDX-License-Identifier: GPL-3.0-or-later
"""The data card: what a dataset contains, how it was made, under what licences, and its known flaws."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from hdpea.dataset.manifest import Manifest, MeshEntry
from hdpea.dataset.sources import UNSTATED
from hdpea.runtime.outputs import replacing

CARD_NAME = "DATASET_CARD.md"

_CARD = """# Dataset card

{samples:,} samples of {meshes:,} surfaces: {points:,} points in {size:.1f} MB, each with its ground truth.
Made by `hdpea dataset build`, hdpea {version}; `manifest.json` has the options, the seed and every hash.

## What is in a sample

An NPZ file, arrays of float32, all in the unit frame of the mesh: centred, bounding-box diagonal 1.

| array | shape | |
|---|---|---|
| points | (n, 3) | as measured by a sensor, with noise, if any |
| surface_points | (n, 3) | true points of the surface; left out where equal to points |
| normals | (n, 3) | normals of the mesh's faces there, unit, outward |
| psi | (n, 5) | [surface_points, psi] is the embedding in R^8, where distances are lengths under the curvature metric |
| curvatures | (n, 2) | principal curvatures, the larger in magnitude first; convex is positive |
| direction1 | (n, 3) | unit principal direction of the first; that of the second is normal x direction1 |
| estimated_normals | (n, 3) | estimated from the points alone, if requested |
| sensors | (n, 3) | position of the sensor that saw the point, if one did |
| centre_in_world, diagonal | (3,), () | float64; world = unit * diagonal + centre_in_world |
| schema | () | version of this list |

`hdpea.dataset.Dataset` reads them, and can rotate and mirror them on loading; `hdpea dataset show` draws one.

## How it was made

Each mesh was merged where vertices are equal, checked to be closed and manifold, and reoriented if it was inside out.
It was remeshed with near-isotropic triangles, its curvature was fitted to the normals of its own faces, and psi was
solved for on the new triangles, as isometric to the metric as the bending term allows. The truth at a point is
interpolated between the corners of the triangle nearest to it.

Lengths of the ground truth are in spacings, sqrt(area / vertices) of the surface; all others in unit length.

| stage | option | value |
|---|---|---|
{options}

## Licences

A sample is derived from its mesh and is subject to the licence of that mesh. `manifest.json` has the origin of each.

| licence of the mesh | meshes | samples |
|---|---|---|
{licences}

"Unstated" means that the source names no licence: ask its owner before distributing these samples.

## Known flaws

- The truth is that of the triangles: on a coarse mesh the curvature is that of its edges, smoothed over the radius
  above, and psi does not resolve features thinner than the length of the triangles.
- Psi is not exactly isometric: a smooth map of that metric need not exist (`hdpea dataset info` measures by how
  much it deviates). It is unique only up to a rigid motion, and depends on the surface as a whole.
- Psi, curvatures and directions are interpolated linearly. Where both curvatures are equal the
  direction is arbitrary; its sign always is.
- Normals are those of the faces, so they jump across every edge of a coarse mesh.

## Skipped

{skipped}
"""


def write_card(folder: Path, manifest: Manifest) -> None:
    """Write the data card of the dataset in `folder`; the same manifest gives the same card.

    Raises
    ------
    UsageError
        If it cannot be written.
    """
    used = [mesh for mesh in manifest.meshes if mesh.skipped is None]
    skipped = [f"- {mesh.name}: {mesh.skipped}" for mesh in manifest.meshes if mesh.skipped is not None]
    card = _CARD.format(
        samples=len(manifest.samples),
        meshes=len(used),
        points=sum(each.points for each in manifest.samples),
        size=sum(each.bytes for each in manifest.samples) / 1e6,
        version=manifest.hdpea,
        options="\n".join(
            f"| {stage} | {name} | {value} |"
            for stage, values in manifest.options.items()
            for name, value in values.items()
        ),
        licences=licence_table(used),
        skipped="\n".join(skipped) or "Nothing.",
    )
    with replacing(folder / CARD_NAME) as partial:
        partial.write_text(card)


def licence_table(meshes: Iterable[MeshEntry]) -> str:
    """Return a row for each licence, the unstated last: the licence, its meshes, its samples."""
    counts: dict[str, tuple[int, int]] = {}
    for mesh in meshes:
        of_licence, samples = counts.get(mesh.licence, (0, 0))
        counts[mesh.licence] = of_licence + 1, samples + len(mesh.samples)
    ordered = sorted(counts.items(), key=lambda each: (each[0].startswith(UNSTATED), each[0]))
    return "\n".join(f"| {licence} | {of_licence} | {samples} |" for licence, (of_licence, samples) in ordered)
