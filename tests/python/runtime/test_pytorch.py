# SPDX-License-Identifier: GPL-3.0-or-later
"""Without PyTorch: what needs it says how to get it, and the rest works."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from helpers import clouds

from hdpea import Options, embed_points, reconstruct
from hdpea.cli import run
from hdpea.errors import UsageError
from hdpea.options.settings import changed


@pytest.fixture(autouse=True)
def _no_torch(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "torch", None)


def test_a_reconstruction_says_how_to_get_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["reconstruct", str(tmp_path / "missing.ply"), str(tmp_path / "mesh.ply")]) == UsageError.exit_code
    assert "pip install torch --index-url" in capsys.readouterr().err
    for embedding in ("direct", "learned"):
        with pytest.raises(UsageError, match="PyTorch is not installed"):
            reconstruct(clouds.sphere(500)[0], embedding=embedding)


def test_an_embedding_that_is_solved_needs_none() -> None:
    points = clouds.sphere(500)[0]
    options = changed(Options(), {"threads": 1})
    assert embed_points(points, options=options).coordinates.shape == (500, 8)
    with pytest.raises(UsageError, match="PyTorch is not installed"):
        embed_points(points, options=changed(options, {"embedding": "learned"}))
