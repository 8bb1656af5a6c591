# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of the validation set, and the best weights by them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.networks import QUICK, SPACING, TINY, InMemory, predicted, torus_sample, unit_torus

from hdpea.geometry.unit_frame import UnitFrame
from hdpea.surface.surface import Surface
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.loop import train
from hdpea.training.validation import mesh_of_embedding, metric_quality, validate


def test_validation_reconstructs_and_keeps_the_best(tmp_path: Path) -> None:
    validation = InMemory({"torus": torus_sample(2000)})
    train(InMemory(), validation, tmp_path, TINY, replace(QUICK, steps=2, validation_vertices=200))
    last = json.loads((tmp_path / "metrics.jsonl").read_text().splitlines()[-1])
    best = Checkpoint.read(tmp_path / "best.pt")
    assert best.best == last["validation_score"]
    sample = validation.read("torus")
    # Training had one thread, which sums in another order.
    assert validate(best.build(), [(sample, SPACING)], 200)["score"] == pytest.approx(best.best, rel=1e-3)
    assert np.isfinite(predicted(best.build(), *unit_torus())).all()


def test_meshes_of_the_metric_are_better_than_others() -> None:
    sample = torus_sample(4000)
    points, normals = np.asarray(sample.points, float), np.asarray(sample.normals, float)
    u = np.stack([-points[:, 1], points[:, 0]], axis=1)
    along = np.hstack([u / np.linalg.norm(u, axis=1, keepdims=True), np.zeros((4000, 1))])
    around = replace(
        sample,
        curvatures=np.tile(np.float32([8.0, 1.0]), (4000, 1)),
        direction1=np.float32(np.cross(normals, along)),
    )
    across = replace(around, direction1=np.float32(along))
    surface = Surface.of(UnitFrame(np.zeros(3), 1.0), points, normals)
    mesh = mesh_of_embedding(surface, 0.3 * np.pad(normals, ((0, 0), (0, 2))), 300)
    assert 0.5 < metric_quality(mesh, around).mean() <= 1
    assert metric_quality(mesh, around).mean() > metric_quality(mesh, across).mean()
