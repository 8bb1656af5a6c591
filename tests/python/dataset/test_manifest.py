# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from hdpea.dataset.manifest import SCHEMA, Manifest, MeshEntry, SampleEntry, read_manifest, write_manifest
from hdpea.dataset.manifest_options import options_for_manifest, options_from_manifest
from hdpea.dataset.options import DatasetOptions
from hdpea.dataset.verification import require_same_bytes
from hdpea.errors import QualityMissed, UnreadableInput
from hdpea.options.settings import filled

DATA = Path(__file__).parent / "data"


def manifest(hdpea: str = "1.0", mesh_hash: str = "00", names: tuple[str, ...] = ("a",), **options: Any) -> Manifest:
    samples = tuple(SampleEntry(name, f"samples/{name}.npz", None, 100, 9894, "11") for name in names)
    mesh = MeshEntry("a", "a.ply", "a site", "CC BY 4.0", mesh_hash, 123, None, samples)
    skipped = MeshEntry("b", "b.ply", "unstated", "unstated", None, 124, "There is no file b.ply.")
    return Manifest(hdpea, options_for_manifest(filled(DatasetOptions, options)), (mesh, skipped))


def test_a_manifest_comes_back_whole_by_its_name_or_its_folder(tmp_path: Path) -> None:
    write_manifest(tmp_path, manifest())
    assert read_manifest(tmp_path) == read_manifest(tmp_path / "manifest.json") == manifest()


@pytest.mark.parametrize("schema", range(1, SCHEMA + 1))
def test_every_schema_ever_written_is_read(schema: int) -> None:
    # Written once, by the version that had the schema; never to be written again.
    frozen = read_manifest(DATA / f"manifest_schema_{schema}.json")
    assert [each.name for each in frozen.meshes] == ["a", "b"]
    assert frozen.samples[0].sha256 == "11"
    assert frozen.options["sampling"]["points"] == 100
    assert frozen.meshes[1].skipped == "There is no file b.ply."


def test_options_are_recorded_there_and_back() -> None:
    options = filled(DatasetOptions, {"kind": "scan", "points": 7, "remesh_length": 0.02, "jobs": 3})
    again = options_from_manifest(options_for_manifest(options), jobs=3)
    assert (again.sample, again.scanning, again.ground_truth, again.jobs) == (
        options.sample,
        options.scanning,
        options.ground_truth,
        3,
    )
    assert json.loads(json.dumps(options_for_manifest(options))) == options_for_manifest(options)


def test_options_that_do_nothing_are_not_recorded() -> None:
    scans, samples = (options_for_manifest(filled(DatasetOptions, {"kind": kind})) for kind in ("scan", "farthest"))
    assert "sampling" not in scans
    assert "scanning" not in samples


@pytest.mark.parametrize("stage", [{"sampling": {"speed": 1}}, {"cooking": {"heat": 1}}])
def test_options_of_another_version_are_told(stage: dict[str, Any]) -> None:
    with pytest.raises(UnreadableInput, match="unknown option"):
        options_from_manifest(stage)


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("", "not the manifest of a dataset"),
        ("[]", "not the manifest of a dataset"),
        ("{}", "not the manifest of a dataset"),
        ('{"schema": 1, "hdpea": "1"}', "not the manifest of a dataset"),
        ('{"schema": 1, "hdpea": "1", "options": {}, "meshes": [{"samples": []}]}', "not the manifest of a dataset"),
        (f'{{"schema": {SCHEMA + 1}}}', f"schema {SCHEMA + 1}, this hdpea reads up to {SCHEMA}"),
    ],
)
def test_what_is_no_manifest_is_told_so(content: str, told: str, tmp_path: Path) -> None:
    (tmp_path / "manifest.json").write_text(content)
    with pytest.raises(UnreadableInput, match=told):
        read_manifest(tmp_path)


def test_a_folder_without_manifest_is_told_so(tmp_path: Path) -> None:
    with pytest.raises(UnreadableInput, match="is not a dataset"):
        read_manifest(tmp_path)


@pytest.mark.parametrize(
    ("made", "told"),
    [
        (manifest(mesh_hash="01"), "The mesh a is not the one that was used then"),
        (manifest(names=()), "The sample a has other bytes"),
        (manifest(names=("a", "c")), "The sample c was not there"),
        (Manifest("1.0", {}), "The mesh a is missing"),
    ],
)
def test_a_rebuilt_dataset_that_differs_is_told(made: Manifest, told: str) -> None:
    require_same_bytes(manifest(), manifest())
    with pytest.raises(QualityMissed, match=told):
        require_same_bytes(manifest(), made)


def test_another_version_is_named_as_the_cause() -> None:
    require_same_bytes(manifest(hdpea="1.0"), manifest(hdpea="2.0"))
    with pytest.raises(QualityMissed) as caught:
        require_same_bytes(manifest(hdpea="1.0"), manifest(hdpea="2.0", names=()))
    assert "built by hdpea 1.0, this is 2.0" in caught.value.hint
