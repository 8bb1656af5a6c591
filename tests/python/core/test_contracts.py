# SPDX-License-Identifier: GPL-3.0-or-later
"""Every function of the core, fed what breaks its contract: InvalidArgument or a result, never a crash.

Each case runs in a process of its own, since what this looks for would take the tests with it.
"""

from __future__ import annotations

import subprocess
import sys

import pytest
from helpers import core_calls

from hdpea import _core


def test_every_function_of_the_core_has_a_call() -> None:
    functions = {name for name in dir(_core) if callable(getattr(_core, name)) and name[0].islower()}
    assert functions == set(core_calls.CALLS)


@pytest.mark.parametrize("name", sorted(core_calls.CALLS))
def test_what_breaks_the_contract_is_refused(name: str) -> None:
    command = [sys.executable, "-m", "helpers.core_calls", name]
    made = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert (made.returncode, made.stderr) == (0, "")
    assert int(made.stdout) >= 1


@pytest.mark.parametrize(
    "name",
    ["estimate_curvature", "moving_least_squares", "sheet_neighbors", "tangent_bases", "tangent_bases_across"],
)
@pytest.mark.parametrize("length", [0.0, 1e-200])
def test_a_normal_without_a_direction_is_refused(name: str, length: float) -> None:
    call, arguments = core_calls.CALLS[name]
    normals = core_calls.NORMALS.copy()
    normals[7] *= length
    with pytest.raises(_core.InvalidArgument, match="must not be 0"):
        call(**arguments | {"normals": normals})
