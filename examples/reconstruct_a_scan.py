# SPDX-License-Identifier: GPL-3.0-or-later
"""From a scan in a file to a mesh, its report and its picture.

    python examples/reconstruct_a_scan.py scan.ply mesh.obj

Makes the mesh that this does:  hdpea reconstruct scan.ply mesh.obj --report mesh.json --picture mesh.png
"""

from __future__ import annotations

import sys
from pathlib import Path

from hdpea import reconstruct
from hdpea.pictures.picture import draw_mesh
from hdpea.reading import read_points


def main(scan: Path, out: Path) -> None:
    """Reconstruct `scan` to `out`, with a report and a picture beside it."""
    cloud = read_points(scan)
    for note in cloud.notes:
        print(note)

    # Every option has a default, which is chosen by what the cloud shows; `vertices=` asks for a size.
    mesh = reconstruct(cloud)

    # With the colours of the scan, and where in the world it lies, if it has them.
    mesh.write(out)
    mesh.report.write(out.with_suffix(".json"))
    draw_mesh(out.with_suffix(".png"), mesh.vertices, mesh.faces)
    print(f"{len(cloud.points)} points -> {len(mesh.vertices)} vertices, {len(mesh.faces)} faces")
    print(f"rms distance of the points: {mesh.report.distances.rms:.3g}, in the scan's units")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
