# SPDX-License-Identifier: GPL-3.0-or-later
"""The output folder of a build: what it may contain beforehand, and what of it can be kept."""

from __future__ import annotations

import re
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

from hdpea.dataset.manifest import MANIFEST_NAME, Manifest, MeshEntry, read_manifest, write_manifest
from hdpea.dataset.sources import Source
from hdpea.errors import UsageError

_HALF_WRITTEN = re.compile(r"\..+\.\d+\.(npz|json|md)")


def open_folder(folder: Path, manifest: Manifest, sources: Sequence[Source]) -> dict[str, MeshEntry]:
    """Prepare `folder` for the dataset of `manifest`; return what an earlier run finished, by name of the mesh.

    A mesh is finished if its file is unchanged and its samples are complete. Partial files of a killed run are
    removed.

    Raises
    ------
    UsageError
        If the folder cannot be created or written, or contains something else.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        empty = not any(folder.iterdir())
    except OSError as error:
        raise UsageError(f"Cannot write to {folder}: {error.strerror}.", "Choose another folder.") from error
    if empty:
        write_manifest(folder, manifest)
        return {}
    if not (folder / MANIFEST_NAME).exists():
        raise UsageError(f"{folder} is not empty, and not a dataset.", "Choose another folder.")
    earlier = read_manifest(folder)
    _require_same(folder, earlier, manifest, sources)
    for path in folder.rglob(".*"):
        if _HALF_WRITTEN.fullmatch(path.name):
            path.unlink()
    by_name = {each.name: each for each in sources}
    return {each.name: each for each in earlier.meshes if _is_finished(folder, each, by_name[each.name])}


def _require_same(folder: Path, earlier: Manifest, manifest: Manifest, sources: Sequence[Source]) -> None:
    hint = "Choose another folder."
    if earlier.hdpea != manifest.hdpea:
        raise UsageError(f"{folder} was built by hdpea {earlier.hdpea}, this is {manifest.hdpea}.", hint)
    for stage, values in manifest.options.items():
        for name, value in values.items():
            was = earlier.options.get(stage, {}).get(name)
            if was != value:
                raise UsageError(f"{folder} was built with {name} = {was}, not {value}.", hint)
    others = {each.name for each in earlier.meshes} - {each.name for each in sources}
    if others:
        raise UsageError(f"{folder} holds samples of other meshes: {', '.join(sorted(others)[:3])}.", hint)


def _is_finished(folder: Path, entry: MeshEntry, source: Source) -> bool:
    as_now = (source.source, source.origin, source.licence, source.sha256())
    if entry.skipped is not None or (entry.source, entry.origin, entry.licence, entry.sha256) != as_now:
        return False
    return all(_is_whole(folder / each.file, each.sha256) for each in entry.samples)


def _is_whole(path: Path, digest: str) -> bool:
    return path.is_file() and sha256(path.read_bytes()).hexdigest() == digest
