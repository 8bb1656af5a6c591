# SPDX-License-Identifier: GPL-3.0-or-later
"""`hdpea train`: from a dataset's folder to a checkpoint, and what can be wrong with the request."""

from __future__ import annotations

import json
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import pytest
from helpers.networks import torus_sample

from hdpea.cli import run
from hdpea.dataset.manifest import Manifest, MeshEntry, SampleEntry, write_manifest
from hdpea.dataset.sample_file import encoded
from hdpea.network.weights import SHIPPED
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.options import PRESETS

SMALL = ["--least-points", "100", "--most-points", "120", "--log-every", "1", "--quiet"]


@pytest.fixture
def dataset(tmp_path: Path) -> str:
    folder = tmp_path / "dataset"
    folder.mkdir()
    data = encoded(torus_sample())
    (folder / "torus.npz").write_bytes(data)
    sample = SampleEntry("torus", "torus.npz", None, 400, len(data), sha256(data).hexdigest())
    mesh = MeshEntry("torus", "torus.ply", "us", "ours", None, 0, None, (sample,))
    write_manifest(folder, Manifest("test", {}, (mesh,)))
    return str(folder)


def test_a_training_starts_and_goes_on(dataset: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    for steps in (1, 2):
        assert run(["train", dataset, str(out), "--steps", str(steps), *SMALL]) == 0
        assert Checkpoint.read(out / "last.pt").step == steps
    lines = [json.loads(line) for line in (out / "metrics.jsonl").read_text().splitlines()]
    assert [line["step"] for line in lines] == [1, 2]


def test_a_dataset_is_packed_and_trained_on(dataset: str, tmp_path: Path) -> None:
    packed, out = str(tmp_path / "packed.safetensors"), tmp_path / "out"
    assert run(["dataset", "pack", dataset, packed]) == 0
    assert run(["train", packed, str(out), "--steps", "1", *SMALL]) == 0
    first = ["--start", str(out / "last.safetensors")]
    assert run(["train", dataset, str(tmp_path / "more"), "--steps", "1", *first, *SMALL]) == 0


def test_packing_replaces_its_own_file_and_no_other(dataset: str, tmp_path: Path) -> None:
    packed = tmp_path / "packed.safetensors"
    assert [run(["dataset", "pack", dataset, str(packed)]) for _ in range(2)] == [0, 0]
    packed.write_bytes(SHIPPED.read_bytes())
    assert run(["dataset", "pack", dataset, str(packed)]) == 2
    assert packed.read_bytes() == SHIPPED.read_bytes()
    assert run(["dataset", "pack", dataset, str(packed), "--force"]) == 0


def test_flags_win_over_the_preset(dataset: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert run(["train", dataset, str(out), "--preset", "paper", "--steps", "1", "--batch", "1", *SMALL]) == 0
    made, paper = Checkpoint.read(out / "last.pt").training, PRESETS["paper"]
    crops = replace(paper.crops, least_points=100, most_points=120)
    assert made == replace(paper, epochs=None, steps=1, batch=1, log_every=1, crops=crops)


@pytest.mark.parametrize(
    ("exit_code", "wrong"),
    [
        (2, ["--batch", "0"]),
        (2, ["--loss", "none"]),
        (2, ["--least-points", "9000", "--most-points", "8000"]),
        (2, ["--margin", "1"]),
        (2, ["--minutes", "1", "--steps", "5"]),
        (2, ["--device", "cuda:99"]),
        (3, ["--validation", "missing"]),
    ],
)
def test_wrong_requests_are_refused(exit_code: int, wrong: list[str], dataset: str, tmp_path: Path) -> None:
    assert run(["train", dataset, str(tmp_path / "out"), *wrong]) == exit_code


def test_a_missing_dataset_and_a_missing_folder_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["train", str(tmp_path / "missing"), str(tmp_path / "out")]) == 3
    assert "missing" in capsys.readouterr().err


def test_the_folder_of_the_folder_must_exist(dataset: str, tmp_path: Path) -> None:
    assert run(["train", dataset, str(tmp_path / "no" / "out"), *SMALL]) == 2


def test_a_damaged_checkpoint_is_not_overwritten(dataset: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "last.pt").write_text("something else")
    assert run(["train", dataset, str(out), "--steps", "1", *SMALL]) == 3
    assert (out / "last.pt").read_text() == "something else"
