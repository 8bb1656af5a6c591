# SPDX-License-Identifier: GPL-3.0-or-later
"""What options change, a small picture for each, for the pages of the commands.

    python benchmarks/option_pictures.py docs/commands/pictures [reconstruct-error ...]

Writes COMMAND-OPTION.jpg; `python tools/command_pages.py docs/commands/*.md` puts each beside its option. Clouds are
those of ``option_clouds``. A mesh that is not as asked for ends it: a picture must not show what an option did not do.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np
import trimesh
from option_clouds import option_clouds
from PIL import Image
from sheets import Mesh, Panel, mesh_picture, opened, save_jpeg, sheet, shrunk

from hdpea.cli import run
from hdpea.pictures.picture import Camera, drawn_to, light_up, look_at
from hdpea.reading.triangle_mesh import read_triangle_mesh

SIZE, FONT_SIZE, LARGEST = (230, 190), 13, 20_000
"""Width and height of a panel and of its letters, in pixels; bytes of a picture."""

LEGEND = 0.95
"""Share of the height of a picture of tensors above its legend."""


@dataclass(frozen=True)
class Shown:
    """The meshes of a cloud by different options.

    Attributes
    ----------
    cloud
        Its file.
    panels
        What is said for each mesh, which is its caption; the first mesh says where the camera stands.
    always
        What is said for all.
    """

    cloud: str
    panels: tuple[str, ...]
    always: str = ""


FEW = "--vertices 300"
MESHES = {
    "vertices": Shown("kitten.xyz", ("", "--vertices 150")),
    "faces": Shown("point_set_3.xyz", ("", "--faces 150")),
    "error": Shown("kitten.xyz", ("--error 2%", "--error 0.5%")),
    "fill-holes": Shown("hole.ply", ("--fill-holes 0", "--fill-holes 30%")),
    "watertight": Shown("hole.ply", ("--fill-holes 0", "--watertight")),
    "outliers": Shown("point_set_3.xyz", ("", "--outliers none")),
    "classes": Shown("classes.ply", ("", "--classes 6")),
    "normal-neighbors": Shown("noisy.ply", ("--normal-neighbors 16", "--normal-neighbors 80"), FEW),
    "orient": Shown("inward.ply", ("--orient wnnc", "--orient file"), FEW),
    "denoise": Shown("noisy.ply", ("--denoise none", "--denoise mls"), FEW),
    "denoise-neighbors": Shown("noisy.ply", ("--denoise-neighbors 20", "--denoise-neighbors 320"), "--denoise mls"),
    "embedding": Shown("kitten.xyz", ("", "--embedding learned"), FEW),
    "bending-length": Shown("knot.ply", ("--bending-length 1%", "--bending-length 20%"), "--vertices 600"),
    "metric-scale": Shown("knot.ply", ("--metric-scale 0.05", "--metric-scale 2"), "--vertices 600"),
    "max-stretch": Shown("knot.ply", ("--max-stretch 1", "--max-stretch 8"), "--vertices 600"),
    "particles": Shown("kitten.xyz", ("", "--particles 300"), FEW),
    "refine": Shown("kitten.xyz", ("", "--no-refine"), FEW),
}
CURVATURES = {
    "method": Shown("knot.ply", ("--method embedding", "--method jet")),
    "vertices": Shown("knot.ply", ("--vertices 100", "--vertices 1500")),
}


def hdpea(folder: Path, command: str, words: str) -> None:
    """Run a command in this process, on files of the folder that are named as ``@kitten.xyz``."""
    code = run([command, *words.replace("@", f"{folder}/").split(), "--force", "--quiet"])
    if code:
        raise click.ClickException(f"hdpea {command} {words} ended with exit code {code}.")


def meshes_row(folder: Path, shown: Shown) -> list[Panel]:
    """Draw the meshes of a cloud."""
    meshes = []
    for words in shown.panels:
        hdpea(folder, "reconstruct", f"@{shown.cloud} @mesh.ply {shown.always} {words}")
        meshes.append(read_triangle_mesh(folder / "mesh.ply"))
    return captioned(meshes, [words or "default" for words in shown.panels])


def captioned(meshes: list[Mesh], captions: list[str]) -> list[Panel]:
    """Draw meshes from where the first is looked at, and put captions and numbers of triangles above."""
    camera = Camera.before(*meshes[0])
    return [
        (f"{caption} ({len(mesh[1]):,})", mesh_picture(mesh, SIZE, camera))
        for caption, mesh in zip(captions, meshes, strict=True)
    ]


def curvatures_row(folder: Path, shown: Shown) -> list[Panel]:
    """Draw the tensors of a cloud, as the command does."""
    panels = []
    for words in shown.panels:
        hdpea(folder, "curvature", f"@{shown.cloud} @k.npz --picture @k.png {words}")
        panels.append((words, fitted(opened(folder / "k.png"))))
    return panels


def fitted(picture: Image.Image) -> Image.Image:
    """Return a picture without its legend, which would be too small to read, on white of the size of a panel."""
    whole = Image.new("RGB", SIZE, "white")
    kept = picture.crop((0, 0, picture.width, round(LEGEND * picture.height)))
    height = kept.height * SIZE[0] // kept.width
    whole.paste(shrunk(kept, (SIZE[0], height)), (0, (SIZE[1] - height) // 2))
    return whole


def levels_row(folder: Path) -> list[Panel]:
    """Draw levels of detail."""
    hdpea(folder, "reconstruct", "@kitten.xyz @mesh.ply --lod 3")
    names = ["mesh", "mesh.lod1", "mesh.lod2"]
    return captioned([read_triangle_mesh(folder / f"{name}.ply") for name in names], names)


def merged_row(folder: Path) -> list[Panel]:
    """Draw the mesh of one scan of two, and that of both."""
    meshes = []
    for words in ("@head.ply", "@body.ply", "@head.ply @body.ply"):
        hdpea(folder, "reconstruct", f"{words} @mesh.ply {'--merge' if ' ' in words else ''}")
        meshes.append(read_triangle_mesh(folder / "mesh.ply"))
    return captioned(meshes[::-1], ["--merge", "body.ply", "head.ply"])[::-1]


def textured_row(folder: Path) -> list[Panel]:
    """Draw colours at the vertices, and the same mesh with a texture."""
    panels, camera = [], None
    for words in ("", "--texture 1024"):
        hdpea(folder, "reconstruct", f"@striped.ply @mesh.obj {FEW} {words}")
        mesh = trimesh.load_mesh(folder / "mesh.obj", process=False)
        camera = camera or Camera.before(np.asarray(mesh.vertices), np.asarray(mesh.faces))
        panels.append((words or "default", colored_picture(mesh, camera)))
    return panels


def colored_picture(mesh: trimesh.Trimesh, camera: Camera) -> Image.Image:
    """Draw a mesh in its colours or with its texture."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "panel.png"
        with drawn_to(path, window_size=list(SIZE), lighting="none") as (pyvista, plotter):
            seen = camera.to_view(np.asarray(mesh.vertices))
            surface = pyvista.PolyData.from_regular_faces(seen, np.asarray(mesh.faces))
            if mesh.visual.kind == "texture":
                surface.active_texture_coordinates = np.asarray(mesh.visual.uv)
                looks = {"texture": pyvista.Texture(np.asarray(mesh.visual.material.image.convert("RGB")))}
            else:
                looks = {"scalars": mesh.visual.vertex_colors[:, :3], "rgb": True}
            plotter.add_mesh(surface, ambient=0.4, diffuse=0.7, **looks)
            look_at(plotter, seen, SIZE)
            light_up(pyvista, plotter)
        return opened(path)


SPECIAL = {"lod": levels_row, "merge": merged_row, "texture": textured_row}
ROWS = {
    **{f"reconstruct-{name}": partial(meshes_row, shown=shown) for name, shown in MESHES.items()},
    **{f"reconstruct-{name}": row for name, row in SPECIAL.items()},
    **{f"curvature-{name}": partial(curvatures_row, shown=shown) for name, shown in CURVATURES.items()},
}


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.argument("names", nargs=-1, type=click.Choice(list(ROWS)))
def main(*, out: Path, names: tuple[str, ...]) -> None:
    """Draw pictures of these NAMES, or all, into OUT."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        option_clouds(folder)
        for each in names or ROWS:
            click.echo(each)
            save_jpeg(sheet([ROWS[each](folder)], SIZE, FONT_SIZE), out / f"{each}.jpg", LARGEST)


if __name__ == "__main__":
    main()
