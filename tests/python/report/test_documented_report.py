# SPDX-License-Identifier: GPL-3.0-or-later
"""Every key of a report is explained in docs/report.md."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers import clouds

from hdpea import reconstruct
from hdpea.cli.ended import Ended
from hdpea.options import Options
from hdpea.options.settings import changed
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import stream_of_cloud
from hdpea.tiling import plan
from hdpea.tiling.run import Tiling, reconstruct_in_tiles

PAGE = (Path(__file__).parents[3] / "docs/report.md").read_text()
EXPLAINED = set(re.findall(r"`([\w-]+)`", PAGE))


def keys_of(value: Any) -> Iterator[str]:
    """Yield the keys of a report at any depth, and what its choices and stages are called."""
    if isinstance(value, list):
        for each in value:
            yield from keys_of(each)
    elif isinstance(value, dict):
        yield from value
        if {"name", "why"} <= set(value) or {"name", "seconds"} <= set(value):
            yield value["name"]
        for each in value.values():
            yield from keys_of(each)


def test_every_key_of_a_report_is_explained() -> None:
    points, _ = clouds.sphere(600)
    grey = np.full(len(points), 7.0)
    options = changed(Options(), {"lod": 2})
    made = reconstruct(points, options=options, vertices=40, attributes={"intensity": grey})
    report = made.report.as_json()
    assert {"edges_collapsed", "pieces_turned"} <= set(report["meshing"]), "the report of a run that does it all"
    report.pop("options")  # which the page of the command explains
    assert set(keys_of(report)) <= EXPLAINED


def test_a_report_of_tiles_is_explained_and_tells_what_one_of_one_piece_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # With halos as usual, tiles of so few points would be all halo.
    monkeypatch.setattr(plan, "HALO", 5.0)
    monkeypatch.setattr(plan, "HALO_OF_VERTICES", 4.0)
    points, _ = clouds.torus(6_000)
    stream = stream_of_cloud(PointCloud(points, None, {}), "torus")
    report = reconstruct_in_tiles(stream, Tiling(tmp_path / "work", 1e9, tile_points=4_000)).report.as_json()
    assert report["counts"]["tiles"] > 1
    report.pop("options")
    assert set(keys_of(report)) <= EXPLAINED
    whole = {each["name"]: each for each in reconstruct(points).report.as_json()["choices"]}
    tiled = {each["name"]: each for each in report["choices"]}
    assert set(tiled) == set(whole) | {"tiles", "halo"}
    # Tiles of a closed surface are open, which are oriented otherwise.
    for name in ("denoise", "vertices", "particles", "iterations"):
        assert tiled[name]["value"] == whole[name]["value"]
    for name in ("bending_length", "curvature_radius", "fill_holes"):
        assert abs(tiled[name]["value"] / whole[name]["value"] - 1) < 0.1


def test_every_key_of_a_line_of_json_is_explained() -> None:
    section = PAGE.split("## A line of JSON")[1]
    assert all(f"`{key}`" in section for key in json.loads(Ended(("a.ply",), "a.mesh.ply").as_line()))
