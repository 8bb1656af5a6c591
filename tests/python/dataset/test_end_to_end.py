# SPDX-License-Identifier: GPL-3.0-or-later
"""A dataset as a user would build it, with nothing stood in for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers.dataset_standins import open_mesh, write_meshes

from hdpea.cli import run
from hdpea.dataset.loading import Dataset


@pytest.mark.slow
def test_a_dataset_is_the_same_for_any_number_of_jobs_and_true(tmp_path: Path) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "b", "c")
    open_mesh(meshes / "open.ply")
    for jobs in "12":
        flags = ["--points", "400", "--vertices", "200", "--estimate", "--quiet"]
        assert run(["dataset", "build", str(meshes), str(tmp_path / jobs), "--jobs", jobs, *flags]) == 0
    for file in (tmp_path / "1").rglob("*.*"):
        assert file.read_bytes() == (tmp_path / "2" / file.relative_to(tmp_path / "1")).read_bytes()
    dataset = Dataset(tmp_path / "1")
    assert dataset.names == ["a", "b", "c"]
    for sample in dataset:
        # Balls of bounding-box diagonal 1, though of few faces.
        assert np.median(sample.curvatures) == pytest.approx(12**0.5, rel=0.2)
        assert np.isfinite(sample.psi).all()
