# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset scan``: a simulated scan of one mesh."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from hdpea.cli.groups import GroupedCommand
from hdpea.cli.parameters import force_option, quiet_option, setting_options
from hdpea.cli.types import PATH
from hdpea.dataset.options import DatasetOptions

EPILOG = """\b
Examples:
  hdpea dataset scan bunny.ply scan.ply --sensor turntable --views 8
  hdpea reconstruct scan.ply mesh.obj
  hdpea dataset scan bunny.ply sample.npz --noise 0.002 --seed 7
  hdpea dataset scan bunny.ply frames.ply --views 8 --flying 50% --misrotated 0.2 --misplaced 0.2%
  hdpea dataset scan bunny.ply rings.ply --sensor lidar --views 3 --outliers 0.5%
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Scan a mesh as a sensor would.")
@click.argument("mesh", type=PATH)
@click.argument("output", metavar="OUT", type=PATH)
@force_option
@quiet_option
@setting_options("scanning", "ground_truth", also=["points", "seed", "estimate"], owner=DatasetOptions)
def command(mesh: Path, output: Path, force: bool, quiet: bool, **values: Any) -> None:
    """Scan the closed mesh MESH by a simulated range sensor.

    OUT is PLY or NPZ. PLY holds the points in the coordinates of the mesh, with the normals of its
    faces and, as sensor_x, sensor_y and sensor_z, the position of the sensor; reconstruct takes it. NPZ
    is a sample, with the ground truth at every point, which takes longer.

    Faults of real scanners are off unless asked for: pixels that fly off edges, views that are
    badly registered, outliers, coordinates in steps. The truth stays that of the surface.

    Lengths are shares of the diagonal of the mesh's bounding box, or spacings
    (sqrt(area / vertices)) where it says so.
    """
    from hdpea.dataset.surface_file import read_surface
    from hdpea.options.settings import filled
    from hdpea.runtime.marks import check_replaceable
    from hdpea.runtime.outputs import check_distinct, check_output
    from hdpea.runtime.progress import shown, tell
    from hdpea.writing.points import POINT_FORMATS

    options = filled(DatasetOptions, values)
    check_output(output, POINT_FORMATS)
    check_distinct([mesh], [output])
    check_replaceable({output: "scan"}, force)
    with shown(quiet) as progress:
        tell(progress, "reading", 0.0)
        vertices, faces = read_surface(mesh)
        if output.suffix.lower() == ".npz":
            from hdpea.dataset.sample_file import write_sample
            from hdpea.dataset.sample_generation import make_sample

            as_scan = replace(options, sample=replace(options.sample, kind="scan"))
            write_sample(output, make_sample(vertices, faces, as_scan, options.scanning.seed, progress))
        else:
            from hdpea.dataset.scan_file import write_scan
            from hdpea.dataset.scanning import scan_surface
            from hdpea.geometry.unit_frame import UnitFrame

            tell(progress, "scanning", 0.0)
            frame = UnitFrame.around(vertices)
            write_scan(output, scan_surface(frame.to_unit(vertices), faces, options.scanning), frame)
