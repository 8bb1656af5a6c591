# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

from helpers import reconstructions

from hdpea.reading.cloud import from_arrays
from hdpea.report.page import write_result_page


def test_a_page_shows_mesh_points_and_what_the_report_says(tmp_path: Path) -> None:
    points, normals = reconstructions.cloud_of("sphere")
    result = reconstructions.mesh_of("sphere")
    cloud, mesh = from_arrays(points, normals), (result.vertices, result.faces)
    write_result_page(tmp_path / "mesh.html", "scan.ply", mesh, cloud, result.report)
    page = (tmp_path / "mesh.html").read_text()
    for name in ("mesh", "points", "distance", "curvature", "stretch"):
        assert f'"name":"{name}"' in page
    assert f"<td>vertices</td><td>{len(result.vertices):,}</td>" in page
    assert "none: closed" in page
