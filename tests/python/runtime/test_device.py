# SPDX-License-Identifier: GPL-3.0-or-later
"""The device on which PyTorch computes: as asked for, told in the report, and an error where there is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import torch
from helpers import clouds

from hdpea import Options, reconstruct
from hdpea.cli import run
from hdpea.errors import UsageError
from hdpea.options import EmbeddingOptions, MeshingOptions
from hdpea.runtime.pytorch import torch_device

GPUS = torch.cuda.device_count() if torch.cuda.is_available() else 0
NONE_THERE = f"cuda:{GPUS}"


def options_on(device: str) -> Options:
    embedding = EmbeddingOptions(embedding="learned", device=device)
    return Options(embedding=embedding, meshing=MeshingOptions(vertices=200))


@pytest.mark.parametrize("name", ["gpu", "cuda:", "cuda:-1", "CPU", ""])
def test_what_is_no_device_is_refused(name: str) -> None:
    with pytest.raises(UsageError, match="`device` is auto, cpu, cuda"):
        EmbeddingOptions(device=name)


def test_a_gpu_that_is_not_there_is_an_error_before_anything_is_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(UsageError, match=f"no device {NONE_THERE}: PyTorch .* finds"):
        torch_device(NONE_THERE)
    with pytest.raises(UsageError, match="There is no device"):
        reconstruct(np.zeros((0, 3)), options=options_on(NONE_THERE))
    np.save(tmp_path / "sphere.npy", clouds.sphere(500)[0])
    for command, made in (("embed", "psi.npz"), ("curvature", "k.npz"), ("reconstruct", "mesh.ply")):
        words = [command, str(tmp_path / "sphere.npy"), str(tmp_path / made), "--embedding", "learned"]
        assert run([*words, "--device", NONE_THERE, "--quiet"]) == UsageError.exit_code
        assert "--device cpu works everywhere" in capsys.readouterr().err
        assert not (tmp_path / made).exists()


def test_the_report_names_the_device() -> None:
    chosen, asked = (reconstruct(clouds.sphere(800)[0], options=options_on(name)) for name in ("auto", "cpu"))
    devices = [each.value for each in chosen.report.choices if each.name == "device"]
    assert devices == ["cuda:0" if GPUS else "cpu"]
    assert asked.report.as_dict()["options"]["embedding"]["device"] == "cpu"
    if not GPUS:
        np.testing.assert_array_equal(chosen.vertices, asked.vertices)


@pytest.mark.skipif(not GPUS, reason="needs a GPU")
def test_a_gpu_gives_the_same_bytes_every_time() -> None:
    first, again = (reconstruct(clouds.sphere(800)[0], options=options_on("cuda")) for _ in range(2))
    np.testing.assert_array_equal(first.vertices, again.vertices)
