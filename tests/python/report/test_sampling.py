# SPDX-License-Identifier: GPL-3.0-or-later
"""A sample of a large cloud tells what the whole would."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea.options import Classes
from hdpea.reading.cleaning import cleaned
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import stream_of_cloud
from hdpea.report import sampling
from hdpea.report.inspection import inspect


def test_a_sample_tells_what_the_whole_cloud_would(monkeypatch: pytest.MonkeyPatch) -> None:
    points, normals = clouds.sphere(20_000)
    classes = np.where(points[:, 2] > 0, 6, 2)
    cloud = PointCloud(1e3 * points, normals, {"classification": classes})
    monkeypatch.setattr(sampling, "SAMPLED", 4_000)
    whole, found = inspect(cleaned(cloud)), sampling.inspect_stream(stream_of_cloud(cloud, "sphere"))
    assert (found.low, found.high, found.normals_oriented) == (whole.low, whole.high, True)
    assert found.counts["points"] == 20_000
    assert found.default_vertices == pytest.approx(whole.default_vertices, rel=0.01)
    assert found.estimated_peak_bytes == pytest.approx(whole.estimated_peak_bytes, rel=0.01)
    assert found.spacing == pytest.approx(whole.spacing, rel=0.1)
    assert "By 3,9" in found.notes[0] or "By 4,0" in found.notes[0]


def test_of_a_class_of_few_points_none_is_missed(monkeypatch: pytest.MonkeyPatch) -> None:
    points, normals = clouds.sphere(20_000)
    classes = np.where(np.arange(20_000) % 10_000 == 7, 6, np.where(points[:, 2] > 0, 9, 2))
    stream = stream_of_cloud(PointCloud(points, normals, {"classification": classes}), "sphere")
    monkeypatch.setattr(sampling, "SAMPLED", 200)
    few = sampling.inspect_stream(stream, Classes((6,)))
    assert (few.counts["points"], few.classes) == (2, {6: 2})
    assert not any("estimates" in note for note in few.notes)
    half = sampling.inspect_stream(stream, Classes((9,)))
    assert half.counts["points"] == (classes == 9).sum()
    sampled = int(half.notes[0].split()[1])
    assert 150 < sampled < 250
