# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import io
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers.samples import sphere_sample

from hdpea.dataset.sample import Sample
from hdpea.dataset.sample_file import SCHEMA, decoded, encoded, read_sample, write_sample
from hdpea.errors import UnreadableInput, UsageError
from hdpea.reading import read_points
from hdpea.runtime.marks import is_marked

FROZEN = Path(__file__).parent / "data" / "sample_schema_1.npz"


def assert_same(one: Sample, other: Sample) -> None:
    for field in fields(Sample):
        if field.name != "frame":
            np.testing.assert_array_equal(getattr(one, field.name), getattr(other, field.name))
    np.testing.assert_array_equal(one.frame.centre_in_world, other.frame.centre_in_world)
    assert one.frame.diagonal == other.frame.diagonal


def arrays_of(sample: Sample) -> dict[str, Any]:
    return dict(np.load(io.BytesIO(encoded(sample))))


def saved(**arrays: Any) -> bytes:
    stream = io.BytesIO()
    np.savez(stream, **arrays)
    return stream.getvalue()


@pytest.mark.parametrize("noise", [0.0, 0.01])
@pytest.mark.parametrize("scanned", [False, True])
def test_a_sample_comes_back_whole(noise: float, scanned: bool, tmp_path: Path) -> None:
    sample = sphere_sample(noise=noise, scanned=scanned)
    write_sample(tmp_path / "sample.npz", sample)
    assert is_marked(tmp_path / "sample.npz", "sample")
    assert_same(read_sample(tmp_path / "sample.npz"), sample)


def test_the_same_sample_is_the_same_bytes() -> None:
    assert encoded(sphere_sample(scanned=True)) == encoded(sphere_sample(scanned=True))
    assert encoded(sphere_sample()) == encoded(decoded(encoded(sphere_sample())))


def test_what_is_not_known_or_known_twice_takes_no_room() -> None:
    assert not {"surface_points", "sensors", "estimated_normals"} & set(arrays_of(sphere_sample()))
    assert "surface_points" in arrays_of(sphere_sample(noise=0.01))


@pytest.mark.parametrize("schema", range(1, SCHEMA + 1))
def test_every_schema_ever_written_is_read(schema: int) -> None:
    # Written once, by the version that had the schema; never to be written again.
    frozen = FROZEN.with_name(f"sample_schema_{schema}.npz")
    expected = sphere_sample(noise=0.01, scanned=True)
    sample = read_sample(frozen)
    np.testing.assert_allclose(sample.embedding, expected.embedding, atol=1e-6)
    np.testing.assert_allclose(sample.curvatures, expected.curvatures, rtol=1e-6)
    assert sample.frame.diagonal == 7
    assert sample.sensors is not None
    assert sample.estimated_normals is not None


def test_a_sample_can_be_read_as_a_cloud(tmp_path: Path) -> None:
    write_sample(tmp_path / "sample.npz", sphere_sample())
    cloud = read_points(tmp_path / "sample.npz")
    assert len(cloud.points) == 50
    assert cloud.normals is not None


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "not an NPZ file, or damaged"),
        (b"solid cube", "not an NPZ file, or damaged"),
        (encoded(sphere_sample())[:2000], "not an NPZ file, or damaged"),
        (saved(points=np.zeros((5, 3))), "not a sample of a dataset"),
        (saved(schema=np.array(["1"])), "not a sample of a dataset"),
        (saved(schema=np.int64(SCHEMA + 1)), f"schema {SCHEMA + 1}, this hdpea reads up to {SCHEMA}"),
        (saved(schema=np.int64(1), points=np.ones((5, 3), "f4")), "without 'normals'"),
        (saved(**{**arrays_of(sphere_sample()), "psi": np.ones((9, 5), "f4")}), "different lengths"),
        (saved(**{**arrays_of(sphere_sample()), "psi": np.ones((50, 4), "f4")}), "array psi is not finite numbers"),
        (saved(**{**arrays_of(sphere_sample()), "points": np.full((50, 3), np.nan)}), "array points is not finite"),
        (saved(**{**arrays_of(sphere_sample()), "points": np.ones(50)}), r"array points has shape \(50,\)"),
        (saved(**{**arrays_of(sphere_sample()), "diagonal": np.ones(2)}), "without"),
    ],
)
def test_what_is_no_sample_is_told_so(content: bytes, told: str, tmp_path: Path) -> None:
    (tmp_path / "sample.npz").write_bytes(content)
    with pytest.raises(UnreadableInput, match=told) as caught:
        read_sample(tmp_path / "sample.npz")
    assert "sample.npz" in caught.value.message


def test_a_flipped_bit_is_noticed() -> None:
    content = bytearray(encoded(sphere_sample()))
    content[len(content) // 2] ^= 1
    with pytest.raises(UnreadableInput):
        decoded(bytes(content))


def test_a_missing_file_is_told_once(tmp_path: Path) -> None:
    with pytest.raises(UnreadableInput, match=r"^There is no file .*sample\.npz\.$"):
        read_sample(tmp_path / "sample.npz")


def test_samples_are_npz(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="extension"):
        write_sample(tmp_path / "sample.ply", sphere_sample())
