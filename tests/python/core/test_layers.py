# SPDX-License-Identifier: GPL-3.0-or-later
"""The folders of the core include downwards only, and no Python."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

CORE = Path(__file__).parents[3] / "src" / "hdpea_cpp"
ORDER = ["base", "points", "embedding", "mesh"]


def sources() -> list[Path]:
    return sorted(CORE.rglob("*.[ch]pp"))


def test_every_source_lies_in_a_folder_of_the_order() -> None:
    assert {path.relative_to(CORE).parts[0] for path in sources()} == set(ORDER)


@pytest.mark.parametrize("path", sources(), ids=lambda path: path.name)
def test_nothing_is_included_upwards(path: Path) -> None:
    text = path.read_text()
    allowed = ORDER[: ORDER.index(path.relative_to(CORE).parts[0]) + 1]
    assert set(re.findall(r'#include "hdpea_cpp/(\w+)/', text)) <= set(allowed)
    assert not re.search(r"#include [<\"](Python\.h|nanobind)", text)
