# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples packed into one file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.networks import METRIC, QUICK, SPACING, TINY, InMemory, network_of, torus_sample

from hdpea.errors import UnreadableInput
from hdpea.network.weights import write_weights
from hdpea.runtime.marks import is_marked
from hdpea.training.loop import train
from hdpea.training.packed import KIND, Packed, write_packed


def test_packed_samples_are_those_packed_to_sixteen_bits(tmp_path: Path) -> None:
    noisy = torus_sample(300)
    noisy = replace(noisy, points=noisy.points + np.float32(0.01), estimated_normals=-noisy.normals)
    samples = InMemory({"clean": torus_sample(400), "noisy": noisy})
    write_packed(tmp_path / "packed.safetensors", samples)
    packed = Packed(tmp_path / "packed.safetensors")
    assert (packed.names, packed.metric, packed.spacing("noisy")) == (samples.names, METRIC, SPACING)
    for name in samples.names:
        given, read = samples.read(name), packed.read(name)
        order = np.argmin(np.linalg.norm(given.points[:, None] - read.points, axis=2), axis=0)
        assert sorted(order) == list(range(len(given.points)))
        for column in ("points", "surface_points", "normals", "psi"):
            np.testing.assert_allclose(getattr(read, column), getattr(given, column)[order], atol=2e-5)
    assert packed.read("clean").estimated_normals is None
    np.testing.assert_allclose(read.estimated_normals, -read.normals, atol=4e-5)
    assert train(packed, None, tmp_path, TINY, replace(QUICK, steps=1)).step == 1


def test_many_samples_do_not_hide_the_mark(tmp_path: Path) -> None:
    sample = InMemory().data["0"]
    samples = InMemory({f"a rather long name of a sample, {number}": sample for number in range(50)})
    for attempt in range(5):  # metadata are written in any order
        path = tmp_path / f"{attempt}.safetensors"
        write_packed(path, samples)
        assert is_marked(path, KIND)


def test_what_is_not_packed_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "packed.safetensors"
    write_weights(path, network_of())
    with pytest.raises(UnreadableInput, match="no packed samples"):
        Packed(path)
    write_packed(path, InMemory())
    path.write_bytes(path.read_bytes()[:500])
    with pytest.raises(UnreadableInput, match="Cannot read"):
        Packed(path)
