# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers import files, scanner_files

from hdpea.reading import read_points, streaming
from hdpea.reading.cleaning import cleaned
from hdpea.reading.streaming import PointStream, stream_of, stream_of_cloud


@pytest.fixture(autouse=True)
def _small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(streaming, "CHUNK", 7)


def assert_streamed_as_read(stream: PointStream | None, path: Path) -> None:
    assert stream is not None
    chunks, whole = list(stream.chunks()), read_points(path)
    assert len(chunks) > 1
    points = np.vstack([chunk.points for chunk in chunks])
    assert (stream.format, stream.crs) == (whole.format, whole.crs)
    assert (stream.attributes() or tuple(chunks[0].attributes)) == tuple(whole.attributes)
    np.testing.assert_array_equal(points[np.isfinite(points).all(axis=1)], whole.points)
    normals = [chunk.normals for chunk in chunks if chunk.normals is not None]
    assert (whole.normals is None) == (not normals)


@pytest.mark.parametrize("byte_order", ["<", ">"])
def test_a_binary_ply_is_streamed_as_it_is_read(tmp_path: Path, byte_order: str) -> None:
    path = tmp_path / "cloud.ply"
    path.write_bytes(files.ply(byte_order=byte_order, extra=True))
    assert_streamed_as_read(stream_of(path), path)


@pytest.mark.parametrize("filled", [False, True])
@pytest.mark.parametrize("compressed", [False, True])
def test_las_is_streamed_as_it_is_read(tmp_path: Path, compressed: bool, filled: bool) -> None:
    path = tmp_path / "cloud.las"
    path.write_bytes(scanner_files.las(compressed, withheld=3, filled=filled))
    assert_streamed_as_read(stream_of(path), path)


def test_other_files_are_read_whole(tmp_path: Path) -> None:
    path = tmp_path / "cloud.ply"
    path.write_bytes(files.ply(text=True))
    assert stream_of(path) is None
    assert stream_of(tmp_path / "missing.las") is None
    cloud = read_points(path)
    stream = stream_of_cloud(cloud, "cloud")
    np.testing.assert_array_equal(np.vstack([chunk.points for chunk in stream.chunks()]), cleaned(cloud).points)
    assert not stream.streamed
