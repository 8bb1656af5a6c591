# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made of the records of a suite: means, tables, curves, error maps."""

from __future__ import annotations

import csv
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from hdpea.benchmark import provenance as provenance_module
from hdpea.benchmark.curves import draw_curves
from hdpea.benchmark.means import COLUMNS, FLOOR, best_of, error_by_size, means_of
from hdpea.benchmark.provenance import commit
from hdpea.benchmark.record import RMS, Record, key_of, read_record, write_record
from hdpea.benchmark.results import curves_of, results_in_markdown
from hdpea.benchmark.scene import ERROR_COLORS, RED_FROM, error_colors, subdivided
from hdpea.benchmark.suite import HELD_OUT, Quoted, Suite, SuiteInput, SuiteMethod, SuiteOptions
from hdpea.benchmark.tables import markdown_table, write_csv
from hdpea.benchmark.winners import winner_sentences
from hdpea.dataset.options import DegradationOptions, SampleOptions, ScanOptions
from hdpea.geometry.triangles import mesh_area
from hdpea.version import version

SUITE = Suite(
    "test",
    SuiteOptions(vertices=(100, 1000)),
    (SuiteInput("clean", SampleOptions(), ScanOptions(), DegradationOptions()),),
    (SuiteMethod("ours", "hdpea", {}), SuiteMethod("theirs", "poisson", {})),
    (Quoted("far away", "table 7", vertices=5180, chamfer=0.496),),
)
EXACT_CD, CD = (
    next(i for i, each in enumerate(COLUMNS) if each.title == title) for title in ("exact CD (1e-5)", "CD (1e-5)")
)


def record(model: str, method: str, chamfer: float, vertices: int = 100, **other: Any) -> Record:
    samples = {"chamfer": 2 * chamfer, "f1": 0.9, "normal_consistency": None, "hausdorff": 0.01}
    accuracy = {"chamfer": chamfer, "hausdorff": 0.01, "samples": samples, "floor": {**samples, "chamfer": 1e-6}}
    scores = {"topology": {"vertices": vertices - 1, "manifold": True}, "accuracy": {"longest_side": accuracy}}
    return Record(model, "clean", method, vertices, "key", scores=scores, **other)


def failure(model: str, method: str, vertices: int = 100) -> Record:
    return Record(model, "clean", method, vertices, "key", failed="It took longer than 1 s.")


RECORDS = [
    record("a", "ours", 1e-5),
    record("b", "ours", 9e-5),
    record("a", "theirs", 3e-5, seconds=2.0),
    failure("b", "theirs"),
    record("a", "ours", 1e-6, 1000),
    record("b", "ours", 1e-6, 1000),
    failure("a", "theirs", 1000),
    failure("b", "theirs", 1000),
]


def test_means_are_over_what_every_method_finished() -> None:
    ours, theirs, floor = means_of(RECORDS, SUITE, "clean", 100)
    assert (ours.finished, ours.tried, theirs.finished, theirs.tried) == (2, 2, 1, 2)
    assert (ours.values[EXACT_CD], theirs.values[EXACT_CD]) == (1e-5, 3e-5)
    assert theirs.times[0] == 2.0
    assert (floor.method, floor.values[CD]) == (FLOOR, 1e-6)


def test_a_method_that_finished_nothing_does_not_take_the_models_from_the_others() -> None:
    ours, theirs, _ = means_of(RECORDS, SUITE, "clean", 1000)
    assert (ours.finished, ours.values[EXACT_CD]) == (2, 1e-6)
    assert theirs.finished == 0
    assert set(theirs.values) == {None}


def test_the_best_are_bold_and_ties_are_not() -> None:
    means = means_of(RECORDS, SUITE, "clean", 100)
    assert best_of(means) == {("ours", EXACT_CD), ("ours", CD)}
    table = markdown_table(means).splitlines()
    assert table[2].startswith("| ours | 2/2 | 99 | **1.000** | 1.000 |")
    assert table[3].startswith("| theirs | 1/2 | 99 | 3.000 | 1.000 |")
    assert len({line.count("|") for line in table}) == 1


def test_who_is_nearest_on_which_model_is_told() -> None:
    records = [*RECORDS[:3], record("b", "theirs", 8e-5)]
    told = "Smallest exact CD: ours on a; theirs on b. Smallest exact HD: ours on a, b."
    assert winner_sentences(records, SUITE, "clean", 100) == told
    told = winner_sentences(RECORDS, SUITE, "clean", 100)
    assert told.startswith("Smallest exact CD: ours on a, b.")  # theirs failed on b
    assert winner_sentences(RECORDS, SUITE, "clean", 1000) == ""  # nobody to compare with
    many = [record(str(i), name, error) for i in range(9) for name, error in (("ours", 2e-5), ("theirs", 1e-5))]
    assert winner_sentences(many, SUITE, "clean", 100).startswith("Smallest exact CD: theirs on 9 models.")


def to_points(model: str, method: str, rms: float, chamfer: float, vertices: int = 100) -> Record:
    """Return a record of a run whose truth is only points."""
    samples = {"chamfer": chamfer, "f1": 0.9, "normal_consistency": None, "hausdorff": 0.01}
    accuracy = {"chamfer": None, "hausdorff": None, "samples": samples, "to_result": {"rms": rms, "max": 10 * rms}}
    scores = {"topology": {"vertices": vertices - 1}, "accuracy": {"longest_side": {**accuracy, "floor": None}}}
    return Record(model, "clean", method, vertices, "key", scores=scores)


TO_POINTS = [
    to_points("a", "ours", 1e-3, 9e-5),
    to_points("a", "theirs", 2e-3, 8e-5),
    to_points("a", "ours", 5e-4, 5e-5, 1000),
    to_points("a", "theirs", 1e-3, 6e-5, 1000),
]


def test_where_the_truth_is_points_their_distances_are_shown_and_ranked_by() -> None:
    table = markdown_table(means_of(TO_POINTS, SUITE, "clean", 100))
    titles, _, ours, theirs = table.splitlines()  # and no floor
    assert "| vertices | exact rms (1e-2) | exact max (1e-2) | CD (1e-5) |" in titles
    assert "| 99 | **0.100** | **1.000** | 9.000 |" in ours
    assert "| 99 | 0.200 | 2.000 | **8.000** |" in theirs
    assert (
        winner_sentences(TO_POINTS, SUITE, "clean", 100) == "Smallest exact rms: ours on a. Smallest CD: theirs on a."
    )
    assert list(curves_of(SUITE, TO_POINTS)) == ["curves-1-rms", "curves-1-max"]
    assert TO_POINTS[0].score(*RMS) == 1e-3


def test_where_the_surface_is_known_one_way_is_not_shown() -> None:
    accuracy = {**RECORDS[0].scores["accuracy"]["longest_side"], "to_result": {"rms": 1.0, "max": 2.0}}
    both = [replace(each, scores={**each.scores, "accuracy": {"longest_side": accuracy}}) for each in RECORDS[:3]]
    table = markdown_table(means_of(both, SUITE, "clean", 100))
    assert "exact CD" in table
    assert "rms" not in table
    assert "rms" not in winner_sentences(both, SUITE, "clean", 100)
    assert not [name for name in curves_of(SUITE, both) if "rms" in name]


def test_what_the_truth_is_is_said_where_it_is_points() -> None:
    held_out = replace(SUITE, options=replace(SUITE.options, truth=HELD_OUT))
    told = results_in_markdown(held_out, TO_POINTS, {})
    assert "which no method was given" in told
    assert "box of the truth" in told
    told = results_in_markdown(SUITE, RECORDS, {})
    assert "no method was given" not in told
    assert "the true surface's box" in told


def test_the_page_of_results_says_all_of_it() -> None:
    told = results_in_markdown(SUITE, RECORDS, {})
    for part in ("## clean, 100 vertices", "far away (quoted) | table 7", "0.496", "theirs@1000: It took longer"):
        assert part in told


def test_columns_without_a_value_are_left_out() -> None:
    (titles, *_) = markdown_table(means_of(RECORDS, SUITE, "clean", 100)).splitlines()
    assert "| vertices |" in titles
    assert "NC" not in titles
    assert "PSNR" not in titles


def test_results_say_where_they_come_from(monkeypatch: pytest.MonkeyPatch) -> None:
    told = results_in_markdown(SUITE, RECORDS, {})
    assert "Models (2): a, b." in told
    assert f"hdpea {version()}" in told
    of_two = [
        replace(RECORDS[0], code="hdpea 1"),
        replace(RECORDS[1], code="hdpea 2"),
        replace(RECORDS[2], code="hdpea 1"),
    ]
    assert "hdpea 1 and hdpea 2, " in results_in_markdown(SUITE, of_two, {})
    monkeypatch.setenv("PATH", "")  # no git
    assert commit() == ""


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_the_commit_is_of_hdpea_and_of_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    git = [str(shutil.which("git")), "-c", "user.name=a", "-c", "user.email=a@b.c", "-C", str(tmp_path)]
    monkeypatch.setattr(provenance_module, "HERE", tmp_path)
    assert commit() == ""
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "commit", "-q", "--allow-empty", "-m", "first"], check=True)
    assert commit() == ""  # some other project
    (tmp_path / "python/hdpea").mkdir(parents=True)
    (tmp_path / "python/hdpea/version.py").touch()
    assert re.fullmatch(r"[0-9a-f]{7,}\+", commit())
    subprocess.run([*git, "add", "."], check=True)
    subprocess.run([*git, "commit", "-q", "-m", "second"], check=True)
    assert re.fullmatch(r"[0-9a-f]{7,}", commit())


def test_every_score_is_in_the_csv(tmp_path: Path) -> None:
    write_csv(tmp_path / "results.csv", RECORDS)
    with (tmp_path / "results.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(RECORDS)
    assert float(rows[0]["accuracy.longest_side.chamfer"]) == 1e-5
    assert (rows[3]["failed"], rows[3]["accuracy.longest_side.chamfer"]) == ("It took longer than 1 s.", "")


def test_records_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "runs" / "record.json"
    assert read_record(path) is None
    write_record(path, RECORDS[0])
    assert read_record(path) == RECORDS[0]
    path.write_text("{")
    assert read_record(path) is None


def test_keys_tell_apart() -> None:
    assert key_of({"a": 1, "b": 2}) == key_of({"b": 2, "a": 1})
    assert key_of({"a": 1}) != key_of({"a": 2})


def test_names_become_names_of_files() -> None:
    stem = Record("folder/model", "noise 0.3 %", "Poisson, ACVD", 100, "").stem
    assert stem.as_posix() == "noise_0.3_%/folder_model/Poisson_ACVD@100"


def test_curves_go_down_where_errors_do() -> None:
    svg = draw_curves("t", "error", {"a": [(1000, 1.0), (100, 10.0)], "b & c": [(100, 5.0)], "none": []})
    root = ElementTree.fromstring(svg)  # noqa: S314 it is our own
    circles = [
        (float(each.get("cx", 0)), float(each.get("cy", 0))) for each in root.iter() if each.tag.endswith("circle")
    ]
    (left, top), (right, bottom), (_, middle) = circles
    assert left < right
    assert top < middle < bottom  # SVG counts downwards
    texts = [each.text for each in root.iter() if each.tag.endswith("text")]
    assert {"b & c", "100", "1,000", "10"} <= set(texts)
    assert "none" not in texts


def test_curves_are_of_geometric_means_over_what_every_method_finished() -> None:
    column = next(each for each in COLUMNS if each.title == "exact CD (1e-5)")
    curves = error_by_size([*RECORDS[:3], record("b", "theirs", 12e-5), *RECORDS[4:]], SUITE, "clean", column)
    assert curves["ours"] == [(99, pytest.approx(3)), (999, pytest.approx(0.1))]  # of 1 and 9
    assert curves["theirs"] == [(99, pytest.approx(6))]  # of 3 and 12; nothing finished at 1,000
    assert error_by_size(RECORDS, SUITE, "clean", column)["ours"][0] == (99, pytest.approx(1))  # theirs failed on b


def test_curves_are_drawn_for_several_sizes() -> None:
    assert list(curves_of(SUITE, RECORDS)) == ["curves-1-cd", "curves-1-hd"]
    assert curves_of(Suite("one", SuiteOptions(), SUITE.inputs, SUITE.methods), RECORDS) == {}


def test_error_maps_show_the_same_surface_in_small_triangles() -> None:
    mesh = trimesh.creation.icosphere(1)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    fine = subdivided(vertices, faces, 0.1)
    assert mesh_area(*fine) == pytest.approx(mesh_area(vertices, faces))
    assert np.linalg.norm(np.diff(fine[0][fine[1]], axis=1), axis=2).max() <= 0.1
    normals = np.cross(*(fine[0][fine[1]][:, k] - fine[0][fine[1]][:, 0] for k in (1, 2)))
    assert (np.einsum("fc,fc->f", normals, fine[0][fine[1]][:, 0]) > 0).all()
    whole = subdivided(vertices, faces, 10)
    np.testing.assert_allclose(whole[0][whole[1]], vertices[faces])


def test_colours_of_errors_end_where_f1_counts_a_point_as_lost() -> None:
    colors = error_colors(np.array([0, RED_FROM, 10]))
    np.testing.assert_array_equal(colors, ERROR_COLORS[[0, -1, -1]])
