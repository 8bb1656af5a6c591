# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ, with vertex colours, or with a texture in files beside it."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.texture import Texture
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import replacing
from hdpea.writing.attributes import colors_of
from hdpea.writing.content import MeshContent


def obj(mesh: MeshContent) -> bytes:
    """Return the content of an OBJ file; every digit of the vertices is in it."""
    if mesh.texture is not None:
        return _textured(mesh, mesh.texture)
    colors = colors_of(mesh.columns)
    rows = mesh.vertices if colors is None else np.hstack([mesh.vertices, np.round(colors / 255.0, 4)])
    return lines(rows, "v ") + lines(mesh.faces + 1, "f ")


def _textured(mesh: MeshContent, texture: Texture) -> bytes:
    across, down = np.round(texture.places, 7).T
    head = f"mtllib {mesh.name}.mtl\n".encode()
    body = lines(mesh.vertices, "v ") + lines(np.stack([across, 1 - down], axis=1), "vt ") + b"usemtl surface\n"
    pairs = np.stack([mesh.faces + 1, texture.corners + 1], axis=-1).tolist()
    return head + body + "".join(f"f {' '.join(f'{v}/{t}' for v, t in face)}\n" for face in pairs).encode()


def lines(rows: NDArray[np.float64] | NDArray[np.int64], prefix: str = "") -> bytes:
    """Return a line for each row, of the shortest texts that read back as the same numbers."""
    return "".join(f"{prefix}{' '.join(map(repr, row))}\n" for row in rows.tolist()).encode()


def texture_files(mesh: Path) -> dict[str, Path]:
    """Return the files beside a textured OBJ by their kind: the material, and the texture that it names."""
    return {"material": mesh.with_suffix(".mtl"), "texture": mesh.with_name(f"{mesh.stem}.texture.png")}


def write_texture_files(mesh: Path, texture: Texture) -> None:
    """Write the material and the texture of an OBJ.

    Raises
    ------
    UsageError
        If a file cannot be written.
    """
    files = texture_files(mesh)
    told = [f"# {mark_of('material')}", "newmtl surface", "Kd 1 1 1", "Ks 0 0 0", f"map_Kd {files['texture'].name}"]
    with replacing(files["material"]) as partial:
        partial.write_text("\n".join(told) + "\n")
    with replacing(files["texture"]) as partial:
        partial.write_bytes(png(texture))


def png(texture: Texture) -> bytes:
    """Return the image of a texture as PNG."""
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    told, stream = PngInfo(), BytesIO()
    told.add_text("Software", mark_of("texture"))
    Image.fromarray(texture.image).save(stream, "PNG", pnginfo=told)
    return stream.getvalue()
