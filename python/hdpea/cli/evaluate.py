# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea evaluate``: how good a mesh is."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from hdpea.cli.groups import GroupedCommand
from hdpea.cli.parameters import setting_options
from hdpea.cli.types import PATH
from hdpea.evaluation.options import EvaluationOptions

EPILOG = """\b
Examples:
  hdpea evaluate mesh.obj true.ply
  hdpea evaluate mesh.obj true.ply --json > scores.json
  hdpea evaluate mesh.obj scan.xyz

\b
The scores:
  CD  sum of the mean squared distances in both directions; smaller is better
  F1  harmonic mean of the shares of points within a distance, either way; 1 is best
  NC  mean |n.n'| of nearest points, in both directions; 1 is best
  HD  largest distance in either direction; smaller is better
  G   quality of the triangles under the truth's curvature; 1 is best
Between samples, CD, F1, NC and HD are limited by a floor: the scores of the truth
against itself. Exact distances, from samples to the other surface, have none;
the largest includes the vertices.

\b
Exit codes: 0 ok, 2 usage, 3 unreadable input, 4 a surface without extent.
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Measure a mesh against the truth.")
@click.argument("result", type=PATH)
@click.argument("truth", type=PATH)
@click.option("--json", "as_json", is_flag=True, help="print everything as JSON; lengths in full, not in 1e-2 or 1e-5")
@setting_options("run", owner=EvaluationOptions, heading="Sampling")
def command(result: Path, truth: Path, as_json: bool, **values: Any) -> None:
    """Measure the mesh RESULT against the true surface TRUTH, in the same units and frame.

    RESULT is PLY, OBJ, STL, OFF or GLB; TRUTH is such a mesh, or a point cloud, which gives fewer
    scores. Lengths are given twice: as shares of the longest side of the truth's bounding box, as
    in the papers of NDC and PoNQ, and of its diagonal, as in that of NASM.
    """
    from hdpea.evaluation.evaluation import evaluate
    from hdpea.evaluation.table import describe
    from hdpea.evaluation.truth import read_truth
    from hdpea.options.settings import filled
    from hdpea.reading.triangle_mesh import read_triangle_mesh

    vertices, faces = read_triangle_mesh(result)
    evaluation = evaluate(vertices, faces, read_truth(truth, filled(EvaluationOptions, values)))
    scores = {"files": {"result": str(result), "truth": str(truth)}, **evaluation.as_dict()}
    click.echo(json.dumps(scores, indent=2) if as_json else describe(evaluation))
