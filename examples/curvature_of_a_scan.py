# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan coloured by curvature: blue where it is flat, red where the curvature is largest.

    python examples/curvature_of_a_scan.py scan.ply colored.ply

View the result in any point cloud viewer; next to it there is a page with the tensors themselves, for a browser.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from plyfile import PlyData, PlyElement

from hdpea import CurvatureOptions, estimate_curvature, read_points
from hdpea.curvature.options import EstimationOptions
from hdpea.curvature.page import write_page
from hdpea.pictures.colors import ratio_colors


def main(scan: Path, out: Path) -> None:
    """Colour `scan` by its larger curvature, from the 5th to the 95th percentile, and write it to `out`."""
    cloud = read_points(scan)
    tensors = estimate_curvature(cloud.points, cloud.normals, CurvatureOptions(EstimationOptions(method="jet")))

    curvature = abs(tensors.curvatures[:, 0])
    known = np.isfinite(curvature)
    low, high = np.percentile(curvature[known], [5, 95])
    # The colours of ratios, from 1 to 4.
    colors = ratio_colors(4 ** np.nan_to_num((curvature - low) / (high - low)).clip(0, 1))

    rows = np.rec.fromarrays([*tensors.points.T, *colors.T, curvature], names="x,y,z,red,green,blue,curvature")
    PlyData([PlyElement.describe(rows, "vertex")]).write(out)
    write_page(out.with_suffix(".html"), tensors, title=scan.name)
    print(f"{known.sum()} of {len(known)} points have a curvature: from {low:.3g} (blue) to {high:.3g} (red)")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
