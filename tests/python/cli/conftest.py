# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan, with strays or not, and stand-ins for the work."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds, standins


@pytest.fixture
def stand_ins(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("hdpea.reconstruction", "hdpea.embedding"):
        monkeypatch.setitem(sys.modules, name, sys.modules.get(name))
    standins.install()


@pytest.fixture
def scan(tmp_path: Path) -> str:
    np.savetxt(tmp_path / "scan.xyz", np.hstack(clouds.torus(800)))
    return str(tmp_path / "scan.xyz")


@pytest.fixture
def scan_with_strays(tmp_path: Path) -> str:
    np.save(tmp_path / "strays.npy", np.vstack([clouds.torus(800)[0], [[9.0, 0.0, 0.0], [0.0, 7.0, 0.0]]]))
    return str(tmp_path / "strays.npy")
