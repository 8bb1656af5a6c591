# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers import dataset_standins

from hdpea.dataset.augmentation import TRANSFORMS
from hdpea.dataset.build import build_dataset
from hdpea.dataset.loading import Dataset
from hdpea.dataset.options import DatasetOptions, GroundTruthOptions
from hdpea.errors import UnreadableInput, UsageError
from hdpea.options.settings import filled


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("hdpea.dataset.build.make_samples", dataset_standins.make_samples)
    meshes = dataset_standins.write_meshes(tmp_path / "meshes", "a", "b")
    build_dataset(str(meshes), tmp_path / "out", filled(DatasetOptions, {"points": 50, "jobs": 1}))
    return tmp_path / "out"


def test_samples_are_read_by_name_and_one_after_another(folder: Path) -> None:
    dataset = Dataset(folder)
    assert len(dataset) == 2
    for name, sample in zip(dataset.names, dataset, strict=True):
        np.testing.assert_array_equal(dataset.read(name).points, sample.points)


def test_the_metric_is_that_of_the_manifest(folder: Path) -> None:
    assert Dataset(folder).metric == GroundTruthOptions().metric
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["options"]["ground_truth"]["metric_scale"] = 20.0
    (folder / "manifest.json").write_text(json.dumps(manifest))
    assert Dataset(folder).metric == replace(GroundTruthOptions().metric, scale=20.0)


def test_augmentations_are_made_on_loading(folder: Path) -> None:
    dataset = Dataset(folder)
    samples = list(dataset.augmented())
    assert len(samples) == len(TRANSFORMS) * len(dataset)
    plain, turned = dataset.read("a"), dataset.read("a", "z_plus_90")
    np.testing.assert_allclose(turned.points, plain.points @ TRANSFORMS["z_plus_90"].T, atol=1e-7)
    np.testing.assert_array_equal(turned.psi, plain.psi)


def test_what_is_not_there_is_told(folder: Path) -> None:
    with pytest.raises(UsageError, match="no sample 'c'"):
        Dataset(folder).read("c")
    with pytest.raises(UsageError, match="no transform 'upside_down'"):
        Dataset(folder).read("a", "upside_down")


def test_a_file_that_was_changed_is_not_believed(folder: Path) -> None:
    (folder / "samples" / "a.npz").write_bytes((folder / "samples" / "b.npz").read_bytes())
    with pytest.raises(UnreadableInput, match="not the file that was built"):
        Dataset(folder).read("a")
    (folder / "samples" / "a.npz").unlink()
    with pytest.raises(UnreadableInput, match="There is no file"):
        Dataset(folder).read("a")
