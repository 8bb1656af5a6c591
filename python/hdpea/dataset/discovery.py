# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and point clouds found in a folder, a file or Thingi10K, with their origins and licences."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from hdpea.dataset.sources import UNSTATED, Source
from hdpea.dataset.thingi10k import THINGI10K, find_models
from hdpea.errors import UnreadableInput
from hdpea.reading import CLOUD_FORMATS
from hdpea.reading.triangle_mesh import SURFACE_FORMATS

LICENCE_FILE = "MANIFEST.json"


def find_meshes(where: str) -> list[Source]:
    """Return the meshes that `where` names, ordered by name: a folder with its subfolders, a file, or thingi10k:ID,ID.

    Origin and licence are those stated for each file in a ``MANIFEST.json`` beside the meshes, or in a folder above:
    ``{"files": [{"path": ..., "licence": ..., "source": ..., "source_path": ...}]}``, with paths relative to it.

    Raises
    ------
    UnreadableInput
        If there is no such file or folder, no mesh in it, or that MANIFEST.json is damaged.
    UsageError
        If Thingi10K has no such models, or its package is not installed.
    """
    if where.startswith(THINGI10K):
        return find_models(where.removeprefix(THINGI10K))
    return _found(Path(where), SURFACE_FORMATS, "meshes")


def find_clouds(where: str) -> list[Source]:
    """Return the point clouds in a folder and its subfolders, or a file, ordered by name; see ``find_meshes``.

    Raises
    ------
    UnreadableInput
        If there is no such file or folder, no cloud in it, or its MANIFEST.json is damaged.
    """
    return _found(Path(where), CLOUD_FORMATS, "point clouds")


def _found(root: Path, formats: tuple[str, ...], kind: str) -> list[Source]:
    """Return the files of these formats; `kind` names them in error messages."""
    if not root.exists():
        raise UnreadableInput(f"There is no file or folder {root}.", "Check the spelling.")
    folder = root if root.is_dir() else root.parent
    files = sorted(root.rglob("*")) if root.is_dir() else [root]
    paths = [path for path in files if path.is_file() and path.suffix.lower() in formats]
    if not paths:
        raise UnreadableInput(f"There are no {kind} in {root}.", f"{kind.capitalize()} end in {', '.join(formats)}.")
    known = _known_origins(folder)
    sources = [_described(path, folder, known) for path in paths]
    return sorted(_named_apart(sources), key=lambda each: each.name)


def _described(path: Path, folder: Path, known: dict[Path, tuple[str, str]]) -> Source:
    relative = path.relative_to(folder)
    origin, licence = known.get(path.resolve(), (UNSTATED, UNSTATED))
    return Source(relative.with_suffix("").as_posix(), relative.as_posix(), path, origin, licence)


def _named_apart(sources: list[Source]) -> list[Source]:
    """Add the extension to names that are not unique, such as those of cube.obj and cube.stl."""
    names = [each.name for each in sources]
    return [each if names.count(each.name) == 1 else replace(each, name=each.source) for each in sources]


def _known_origins(folder: Path) -> dict[Path, tuple[str, str]]:
    """Return origin and licence by path, from the nearest MANIFEST.json at or above the folder."""
    manifests = (above / LICENCE_FILE for above in (folder.resolve(), *folder.resolve().parents))
    manifest = next((each for each in manifests if each.is_file()), None)
    if manifest is None:
        return {}
    try:
        files = json.loads(manifest.read_text())["files"]
        return {(manifest.parent / each["path"]).resolve(): _origin_and_licence(each) for each in files}
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise UnreadableInput(
            f"Cannot read the licences in {manifest}: {error!r}.", 'It is {"files": [{"path": ..., "licence": ...}]}.'
        ) from error


def _origin_and_licence(record: dict[str, object]) -> tuple[str, str]:
    origin = ": ".join(str(record[key]) for key in ("source", "source_path") if record.get(key))
    return origin or UNSTATED, str(record.get("licence") or record.get("license") or UNSTATED)
