# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from hdpea import version

ROOT = Path(__file__).parents[2]


def test_what_is_compiled_in_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    built = {"commit": "0123abc+", "compiler": "GNU 12.2.0", "libraries": {"CGAL": "5.5.1", "oneTBB": ""}}
    (tmp_path / "build.json").write_text(json.dumps(built))
    monkeypatch.setattr(version, "BUILD", tmp_path / "build.json")
    first, runs_on, compiled = version.described()
    assert first == f"hdpea {version.version()} (commit 0123abc+)"
    assert runs_on.startswith("runs on Python 3.")
    assert compiled == "compiled by GNU 12.2.0 with CGAL 5.5.1, oneTBB"


def test_a_source_tree_tells_what_it_knows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(version, "BUILD", tmp_path / "build.json")
    assert len(version.described()) == 2
    assert version.version("no-such-package") == version.UNKNOWN


def test_the_citation_names_the_version() -> None:
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert f"version: {declared}\n" in (ROOT / "CITATION.cff").read_text()
