# SPDX-License-Identifier: GPL-3.0-or-later
"""The order of the packages is the same in CONTRIBUTING.md, in the contract of import-linter and on the disk."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
LAYERS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"][0]["layers"]


def test_contributing_states_the_order_of_the_contract() -> None:
    table = (ROOT / "CONTRIBUTING.md").read_text().split("| package | does |\n|---|---|\n")[1].split("\n\n")[0]
    rows = [re.findall(r"`(\w+)`", line.replace("\\|", "").split("|")[1]) for line in table.splitlines()]
    assert rows == [layer.split(" | ") for layer in LAYERS]


def test_every_package_has_its_place() -> None:
    package = ROOT / "python" / "hdpea"
    modules = {path.stem for path in package.glob("*.py")} - {"__init__"}
    modules |= {path.parent.name for path in package.glob("*/__init__.py")}
    assert modules == {each for layer in LAYERS for each in layer.split(" | ")}
