# SPDX-License-Identifier: GPL-3.0-or-later
"""Any program that reads points from one file and writes a mesh to another."""

from __future__ import annotations

import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.options import CommandOptions
from hdpea.errors import CannotReconstruct, UsageError
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading.triangle_mesh import read_triangle_mesh
from hdpea.writing.points import point_ply


def reconstruct(cloud: Cloud, vertices: int, options: CommandOptions) -> TriangleMesh:
    """Run the program, without a shell, in the folder of the suite; return the mesh that it wrote.

    Raises
    ------
    UsageError
        If there is no such program.
    CannotReconstruct
        If it fails, or writes no mesh.
    """
    with TemporaryDirectory() as folder:
        points, mesh = Path(folder) / "points.ply", Path(folder) / f"mesh{options.format}"
        points.write_bytes(point_ply(cloud.points, cloud.normals, {}))
        words = options.words(str(points), str(mesh), vertices)
        try:
            done = subprocess.run(  # noqa: S603 the program is named by the suite
                words, cwd=options.folder or None, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
            )
        except OSError as error:
            raise UsageError(
                f"Cannot run {words[0]}: {error.strerror}.", "Is it installed, and on the PATH?"
            ) from error
        if done.returncode or not mesh.exists():
            said = (done.stderr.strip() or done.stdout.strip() or "nothing").splitlines()[-1]
            raise CannotReconstruct(f"{words[0]} made no mesh; it ended with {done.returncode} and said: {said}")
        return read_triangle_mesh(mesh)
