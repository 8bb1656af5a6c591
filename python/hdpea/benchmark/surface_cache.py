# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces before their reduction, made once for all reductions and sizes; their cost counts for each of these."""

from __future__ import annotations

from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from hdpea.benchmark.measured_mesh import MeasuredMesh, measured
from hdpea.benchmark.methods import METHODS, Cloud
from hdpea.benchmark.record import key_of
from hdpea.runtime.outputs import replacing
from hdpea.version import version


def cached_surface(cloud: Cloud, method: str, options: Any, folder: Path) -> MeasuredMesh:
    """Return the surface that a method makes of a cloud before its reduction, from `folder` if it is there already."""
    settings = {name: value for name, value in asdict(options).items() if name != "reduce"}
    given = sha256(cloud.points.tobytes() + cloud.normals.tobytes()).hexdigest()
    key = key_of(version(), given, method, settings)
    path = folder / f"{method}-{key[:16]}.npz"
    kept = _read(path)
    if kept is not None:
        return kept
    surface = METHODS[method].load("surface")
    made = measured(lambda: surface(cloud, options))
    folder.mkdir(parents=True, exist_ok=True)
    with replacing(path) as partial, partial.open("wb") as file:
        np.savez(
            file,
            vertices=made.mesh[0],
            faces=made.mesh[1],
            took=np.array([made.seconds, made.cpu_seconds, made.peak_bytes]),
        )
    return made


def _read(path: Path) -> MeasuredMesh | None:
    """Read a surface; None if it is missing or damaged."""
    try:
        with path.open("rb") as file, np.load(file) as arrays:
            seconds, cpu_seconds, peak_bytes = arrays["took"].tolist()
            return MeasuredMesh((arrays["vertices"], arrays["faces"]), seconds, cpu_seconds, int(peak_bytes))
    except (OSError, ValueError, KeyError, BadZipFile):
        return None
