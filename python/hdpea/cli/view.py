# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea view``: meshes and clouds in the browser."""

from __future__ import annotations

import webbrowser
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import gettempdir
from typing import TYPE_CHECKING, Any

import click

from hdpea.cli.groups import GroupedCommand, GroupedOption
from hdpea.cli.parameters import force_option, up_option
from hdpea.cli.types import PATH
from hdpea.errors import UnreadableInput
from hdpea.runtime.marks import check_replaceable
from hdpea.runtime.outputs import check_distinct, check_output

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from hdpea.pages.shapes import Shape

EPILOG = """\b
Examples:
  hdpea view mesh.obj
  hdpea view mesh.obj other.ply scan.ply
  hdpea view scan.xyz --page scan.html

\b
Exit codes: 0 ok, 1 internal error, 2 usage, 3 unreadable input, 130 interrupted.
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Look at meshes and clouds.")
@click.argument("sources", metavar="FILE...", type=PATH, nargs=-1, required=True)
@click.option("--page", cls=GroupedOption, type=PATH, help="write the page here, and do not open it")
@up_option
@force_option
def command(*, sources: tuple[Path, ...], page: Path | None, up: str | None, force: bool) -> None:
    """Show meshes and point clouds in the browser: turned, coloured, side by side.

    FILE is a mesh (PLY, OBJ, STL, OFF, GLB, NPZ) or a point cloud, as for reconstruct. Several are
    shown in the same coordinates, the second beside the first; meshes are coloured by their distance
    to the first cloud among them. The page is one HTML file that needs nothing else; without --page it
    lies in the folder for temporary files, and its name is told.
    """
    from hdpea.pages.colorings import COLOR, DISTANCE
    from hdpea.pages.page import PAGE_FORMATS, write_page

    written = page or Path(gettempdir()) / f"hdpea-{sources[0].stem}.html"
    check_output(written, PAGE_FORMATS)
    check_distinct(sources, [written])
    check_replaceable({written: "page"}, force)
    shapes = list(_shapes(sources))
    title, beside = ", ".join(each.name for each in sources), 1 if len(shapes) > 1 else None
    figures = list(_figures(shapes))
    write_page(written, title, shapes, figures, coloring=DISTANCE if figures else COLOR, beside=beside, up=up)
    click.echo(f"{written}: {written.stat().st_size / 1e6:.1f} MB; it opens in any browser", err=True)
    if page is None and not webbrowser.open(written.resolve().as_uri()):
        click.echo("No browser could be opened here: open it where there is one.", err=True)


def _figures(shapes: Sequence[Shape]) -> Iterator[tuple[str, str]]:
    """Yield how far the points of each cloud are from the mesh, if there is one."""
    import numpy as np

    from hdpea.pages.colorings import DISTANCE
    from hdpea.pages.shapes import PointShape

    for shape in shapes:
        if not isinstance(shape, PointShape):
            continue
        for each in shape.colorings:
            if each.name == DISTANCE:
                yield f"{shape.name} to mesh, rms", f"{np.sqrt(np.mean(each.values**2)):.3g}"
                yield "95 % within", f"{np.percentile(each.values, 95):.3g}"
                yield "at most", f"{each.values.max():.3g}"
                yield "size of the cloud", " x ".join(f"{side:.3g}" for side in np.ptp(shape.points, axis=0))


def _shapes(sources: tuple[Path, ...]) -> Iterator[Shape]:
    from hdpea.pages.colorings import mesh_shape, point_shape
    from hdpea.reading import read_points
    from hdpea.reading.triangle_mesh import read_triangle_mesh

    meshes, clouds = {}, {}
    for each in sources:
        try:
            meshes[each] = read_triangle_mesh(each)
        except UnreadableInput:
            clouds[each] = read_points(each)
    cloud, mesh = next(iter(clouds.values()), None), next(iter(meshes.values()), None)
    for each in sources:
        if each in meshes:
            points = None if cloud is None else cloud.points
            yield mesh_shape(each.name, *meshes[each], points, _attributes(each, meshes[each][0]))
        else:
            yield point_shape(each.name, clouds[each].points, mesh, clouds[each].attributes)


def _attributes(path: Path, vertices: NDArray[np.float64]) -> Mapping[str, NDArray[Any]]:
    """Return what the file says about the vertices, if it is of a format that says it and all of them have faces."""
    import numpy as np

    from hdpea.reading import read_points
    from hdpea.reading.glb import colors_at

    if path.suffix.lower() == ".glb":
        return colors_at(path, vertices)
    cloud = read_points(path) if path.suffix.lower() == ".ply" else None
    return cloud.attributes if cloud is not None and np.array_equal(cloud.points, vertices) else {}
