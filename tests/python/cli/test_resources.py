# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import click
import numpy as np
import pytest
from helpers import clouds

from hdpea.cli import run
from hdpea.cli.tiles import MemoryType, Resources, stream_beyond
from hdpea.errors import UsageError
from hdpea.options import NormalOptions, Options


@pytest.mark.parametrize(("text", "size"), [("4GB", 4e9), ("1.5 gb", 1.5e9), ("300MB", 3e8), ("1000", 1e3)])
def test_sizes_are_understood(text: str, size: float) -> None:
    assert MemoryType().convert(text, None, None) == size


@pytest.mark.parametrize("text", ["", "GB", "-1GB", "0", "nan", "infGB", "4 parsecs"])
def test_what_is_no_size_is_refused(text: str) -> None:
    with pytest.raises(click.BadParameter):
        MemoryType().convert(text, None, None)


def test_the_memory_decides_what_is_made_in_one_piece(tmp_path: Path) -> None:
    options = Options()
    assert Resources(8e9).suffice(1_000_000, options, normals=False)
    assert not Resources(1e9).suffice(1_000_000, options, normals=True)
    # 2.8 GB with normals, 3.9 if they have to be estimated.
    estimated = Options(normals=NormalOptions(normals="estimate"))
    assert Resources(3.3e9).suffice(1_000_000, options, normals=True)
    assert not Resources(3.3e9).suffice(1_000_000, options, normals=False)
    assert not Resources(3.3e9).suffice(1_000_000, estimated, normals=True)
    assert Resources().bytes() > 0
    path = tmp_path / "cloud.xyz"
    path.write_text("0 0 0\n")
    assert stream_beyond((str(path),), options, Resources(1.0)) is None


def test_tiles_lie_beside_the_mesh_unless_a_folder_is_named(tmp_path: Path) -> None:
    assert Resources().work_folder(tmp_path / "mesh.ply") == tmp_path / "mesh.ply.tiles"
    assert Resources(folder=tmp_path).work_folder(None) == tmp_path
    with pytest.raises(UsageError, match="folder"):
        Resources().work_folder(None)


def test_info_tells_what_will_be_made_in_tiles(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    np.save(tmp_path / "scan.npy", clouds.sphere(40_000)[0])

    def told(memory: float) -> str:
        monkeypatch.setattr(Resources, "bytes", lambda _: memory)
        assert run(["info", str(tmp_path / "scan.npy")]) == 0
        return capsys.readouterr().out

    assert "in tiles" not in told(1e9)
    little = told(0.32e9)  # of which the least process takes 0.28
    assert "in tiles with --jobs 1, 0.3 GB in each process" in little
    assert "GB of the disk, for 5,000 vertices; in one piece about" in little
    assert "more memory than that, even in tiles; in one piece about" in told(1.0)
