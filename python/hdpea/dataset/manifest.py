# SPDX-License-Identifier: GPL-3.0-or-later
"""The manifest of a dataset: all that is needed to build it again, byte for byte, and to check its files.

It contains nothing that differs between two builds of the same dataset: no times, no dates, no absolute paths.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from hdpea.errors import UnreadableInput
from hdpea.reading import read_bytes
from hdpea.runtime.outputs import replacing

SCHEMA = 1
MANIFEST_NAME = "manifest.json"


@dataclass(frozen=True)
class SampleEntry:
    """A file of the dataset: its path in the folder, the transform applied (None: none), its size and its hash."""

    name: str
    file: str
    augmentation: str | None
    points: int
    bytes: int
    sha256: str


@dataclass(frozen=True)
class MeshEntry:
    """A mesh, and its samples or the reason why there are none.

    Attributes
    ----------
    name, source
        Unique name of the mesh; its file in the folder of meshes, or ``thingi10k:ID``.
    origin, licence
        Where it comes from and its terms of use, as far as known.
    sha256
        Hash of the mesh's file; None if it could not be read.
    seed
        Seed of everything random in its samples.
    skipped
        Why there are no samples of it; None if there are.
    """

    name: str
    source: str
    origin: str
    licence: str
    sha256: str | None
    seed: int
    skipped: str | None = None
    samples: tuple[SampleEntry, ...] = ()


@dataclass(frozen=True)
class Manifest:
    """What a dataset was built from: the version, every option by stage and name, and the meshes by name."""

    hdpea: str
    options: Mapping[str, Mapping[str, Any]]
    meshes: tuple[MeshEntry, ...] = ()

    @property
    def samples(self) -> tuple[SampleEntry, ...]:
        """Every sample, mesh by mesh."""
        return tuple(sample for mesh in self.meshes for sample in mesh.samples)


def write_manifest(folder: Path, manifest: Manifest) -> None:
    """Write the manifest of the dataset in `folder`, whole or not at all.

    Raises
    ------
    UsageError
        If it cannot be written.
    """
    with replacing(folder / MANIFEST_NAME) as partial:
        partial.write_text(json.dumps({"schema": SCHEMA, **asdict(manifest)}, indent=1) + "\n")


def manifest_file(path: Path) -> Path:
    """Return the manifest's file, given that or the folder of the dataset."""
    return path / MANIFEST_NAME if path.is_dir() else path


def read_manifest(path: Path) -> Manifest:
    """Read the manifest of a dataset, given the file or its folder.

    Raises
    ------
    UnreadableInput
        If there is none, it is damaged, or of a newer schema.
    """
    file = manifest_file(path)
    if path.is_dir() and not file.exists():
        raise UnreadableInput(
            f"{path} is not a dataset: it has no {MANIFEST_NAME}.", "`hdpea dataset build` makes one."
        )
    try:
        content = json.loads(read_bytes(file))
        schema = content["schema"]
        read = _READERS.get(schema)
        if read is not None:
            return read(content)
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError) as error:
        what = f"it is not the manifest of a dataset ({type(error).__name__}: {error})"
        raise UnreadableInput(f"Cannot read {file}: {what}.", "Build the dataset again.") from error
    raise UnreadableInput(
        f"Cannot read {file}: it is a manifest of schema {schema}, this hdpea reads up to {SCHEMA}.", "Update hdpea."
    )


def _read_1(content: Mapping[str, Any]) -> Manifest:
    meshes = [
        MeshEntry(**{**mesh, "samples": tuple(SampleEntry(**each) for each in mesh["samples"])})
        for mesh in content["meshes"]
    ]
    return Manifest(content["hdpea"], content["options"], tuple(meshes))


_READERS = {1: _read_1}
