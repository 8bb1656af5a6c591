# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hdpea.options import Options, ParticleOptions
from hdpea.options.choice import Choice
from hdpea.report.achieved_error import AchievedError
from hdpea.report.agreement import Agreement
from hdpea.report.facts import Distances, MeshFacts
from hdpea.report.measurement import Comparison
from hdpea.report.report import Journal, Report
from hdpea.report.summary import summarize

SPHERE = MeshFacts(
    5000, 9996, manifold=True, closed=True, components=1, boundary_loops=0, genus=0, self_intersections=0
)


ERROR = AchievedError(asked=None, points_to_mesh=4.0, mesh_to_points=3.0, moved_by_denoising=0.0)


def report_of(journal: Journal, facts: MeshFacts = SPHERE) -> Report:
    distances = Distances.of(np.array([0.0, 3.0, 4.0]), spacing=0.5)
    return Report.of(journal, facts, distances, Agreement(0.02, 0.01), ERROR)


def filled() -> Report:
    report = report_of(Journal(options=Options(particles=ParticleOptions(seed=7))))
    report.counts["points"] = 40_000
    report.choices.append(Choice("curvature radius", 0.0123, "world units", "twice the vertex spacing"))
    report.meshing["t3"] = np.int64(10_000)  # type: ignore[assignment]  # numpy's numbers slip in easily
    report.notes.append("12 points were dropped.")
    with report.clock.stage("embedding"):
        pass
    return report


def written(report: Report, folder: Path) -> dict[str, Any]:
    report.write(folder / "report.json")
    content: dict[str, Any] = json.loads((folder / "report.json").read_text())
    return content


def test_everything_is_in_the_file(tmp_path: Path) -> None:
    content = written(filled(), tmp_path)
    assert content["options"]["particles"]["seed"] == 7
    assert content["counts"] == {"points": 40_000}
    assert content["choices"][0]["why"] == "twice the vertex spacing"
    assert content["meshing"] == {"t3": 10_000}
    assert content["mesh"]["genus"] == 0
    assert content["agreement"] == {"points_without_mesh": 0.02, "area_without_points": 0.01}
    assert content["error"]["points_to_mesh"] == 4.0
    assert content["notes"] == ["12 points were dropped."]
    assert [stage["name"] for stage in content["stages"]] == ["embedding"]
    assert content["total"]["peak_bytes"] > 0


def test_a_run_that_noted_nothing_has_a_report(tmp_path: Path) -> None:
    content = written(report_of(Journal(options=Options())), tmp_path)
    assert (content["choices"], content["notes"], content["total"]["seconds"]) == ([], [], 0)


def test_nan_becomes_null_instead_of_an_error_at_the_end_of_a_long_run(tmp_path: Path) -> None:
    report = report_of(Journal(options=Options()))
    report.choices.append(Choice("radius", float("nan"), "world units", "a bug"))
    assert written(report, tmp_path)["choices"][0]["value"] is None


def test_distances_in_both_units() -> None:
    distances = Distances.of(np.array([0.0, 3.0, 4.0]), spacing=0.5)
    assert distances.rms == pytest.approx((25 / 3) ** 0.5)
    assert distances.as_dict()["in_world_units"]["max"] == 4.0
    assert distances.as_dict()["in_spacings"]["max"] == 8.0


def test_summary_is_short_and_says_what_came_out() -> None:
    lines = summarize(filled(), "mesh.obj", verbose=True).splitlines()
    assert len(lines) == 5
    assert lines[-1].startswith("mesh.obj: written after")
    assert len(summarize(filled(), "mesh.obj").splitlines()) == 4
    assert "mesh: 5,000 vertices, 9,996 faces, manifold, closed, 1 component, genus 0" in lines
    assert "curvature radius: 0.0123 world units (twice the vertex spacing)" in lines


def test_summary_does_not_hide_a_bad_mesh() -> None:
    torn = replace(
        SPHERE, manifold=False, closed=False, components=2, boundary_loops=3, genus=None, self_intersections=1
    )
    assert "NOT manifold, 3 boundary loops, 2 components, 1 self-intersection" in summarize(
        report_of(Journal(options=Options()), torn), "mesh.obj"
    )


@pytest.mark.parametrize(("farthest", "told"), [(2.6, True), (1.3, False)])
def test_a_part_without_mesh_is_told(farthest: float, told: bool) -> None:
    compared = Comparison(Distances.of(np.array([0.0, 4.0]), spacing=0.5), Agreement(0.0, 0.0), farthest, np.zeros(2))
    assert any("A part may be missing: points lie up to 4" in line for line in compared.missing_part()) == told
    lacking = compared._replace(farthest=3.0, agreement=Agreement(0.055, 0.0), pieces_left_out=9)
    (said,) = lacking.missing_part()
    assert "3.0 times as far as its vertices are apart; 5.5% have none near." in said
    assert "9 pieces of few faces left out: `min_component` 0 keeps such" in said
