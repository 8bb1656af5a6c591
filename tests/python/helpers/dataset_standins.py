# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-in for what makes the samples of a mesh, which does as the mesh's name says; and meshes for it."""

from __future__ import annotations

import json
import os
import signal
import time
from pathlib import Path

import numpy as np
import trimesh
from helpers.samples import numbered_sample

from hdpea.dataset import build
from hdpea.dataset.sample_file import encoded
from hdpea.dataset.surface_file import read_surface


def make_samples(task: build.Task) -> list[build.EncodedSample]:
    """Return a sample without psi, after what the name says has happened."""
    name = task.source.name
    if "crash" in name:
        os.kill(os.getpid(), signal.SIGSEGV)
    if "hang" in name:
        time.sleep(60)
    if "bug" in name:
        raise ZeroDivisionError("a bug")
    if "slow" in name:
        time.sleep(0.3)
    made = numbered_sample(read_surface(task.source.path), points=task.options.sampling.points, seed=task.seed)
    return [build.EncodedSample(None, len(made.points), encoded(made))]


def write_meshes(folder: Path, *names: str) -> Path:
    """Write a ball of another size under each name, and a MANIFEST.json with licences for all but the last."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, name in enumerate(names):
        ball = trimesh.creation.icosphere(subdivisions=1, radius=1 + number)
        ball.export(folder / f"{name}.ply")
    files = [
        {"path": f"{name}.ply", "licence": f"licence {number}", "source": "a site", "source_path": f"at/{name}"}
        for number, name in enumerate(names[:-1])
    ]
    (folder / "MANIFEST.json").write_text(json.dumps({"files": files}))
    return folder


def open_mesh(path: Path) -> None:
    """Write a ball with a hole."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    trimesh.Trimesh(ball.vertices, np.asarray(ball.faces)[1:], process=False).export(path)


if __name__ == "__main__":
    build.make_samples = make_samples
    from hdpea.cli import main

    main()
