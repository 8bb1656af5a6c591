# SPDX-License-Identifier: GPL-3.0-or-later
"""Verification that a dataset built again is the same."""

from __future__ import annotations

from hdpea.dataset.manifest import Manifest
from hdpea.errors import QualityMissed


def require_same_bytes(wanted: Manifest, made: Manifest) -> None:
    """Check that every file listed in `wanted` was built again with the same bytes, and no other file.

    Raises
    ------
    QualityMissed
        If not; the message names the first difference, the hint a possible cause.
    """
    meshes = {each.name: each for each in made.meshes}
    for mesh in wanted.meshes:
        if mesh.name not in meshes:
            raise _missed(f"The mesh {mesh.name} is missing", wanted, made)
        if meshes[mesh.name].sha256 != mesh.sha256:
            raise _missed(f"The mesh {mesh.name} is not the one that was used then", wanted, made)
    hashes = {each.name: each.sha256 for each in made.samples}
    for sample in wanted.samples:
        if hashes.pop(sample.name, None) != sample.sha256:
            raise _missed(f"The sample {sample.name} has other bytes", wanted, made)
    if hashes:
        raise _missed(f"The sample {min(hashes)} was not there", wanted, made)


def _missed(difference: str, wanted: Manifest, made: Manifest) -> QualityMissed:
    if wanted.hdpea == made.hdpea:
        hint = "The bytes are the same for the same meshes, version and libraries."
    else:
        hint = f"It was built by hdpea {wanted.hdpea}, this is {made.hdpea}."
    return QualityMissed(f"{difference}: this is not the same dataset.", hint)
