# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from hdpea.runtime import clock as measuring
from hdpea.runtime.clock import StageClock

HUNDRED_MB = 100_000_000


def test_stages_are_in_order_and_timed() -> None:
    clock = StageClock()
    with clock.stage("first"):
        time.sleep(0.02)
    with clock.stage("second"):
        pass
    first, second = clock.stages
    assert (first.name, second.name) == ("first", "second")
    assert first.seconds >= 0.02 > second.seconds


@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="the peak can be reset on Linux only")
def test_memory_counts_for_the_stage_that_takes_it() -> None:
    # In a process of its own: in one that freed much before, an array may take no memory anew.
    program = f"""
import numpy as np
from hdpea.runtime.clock import StageClock, peak_of_process_bytes

clock = StageClock()
with clock.stage("large"):
    np.ones({HUNDRED_MB}, dtype=np.uint8)
with clock.stage("small"):
    pass
print(*(stage.peak_bytes for stage in clock.stages), peak_of_process_bytes())
"""
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    large, small, ever = map(int, told.split())
    assert large - small > 0.9 * HUNDRED_MB
    assert ever >= large


def test_outer_stages_include_the_inner_ones_and_the_total_counts_them_once() -> None:
    clock = StageClock()
    with clock.stage("outer"), clock.stage("inner"):
        np.ones(HUNDRED_MB, dtype=np.uint8)
    outer, inner = clock.stages
    assert (outer.level, inner.level) == (0, 1)
    assert outer.peak_bytes >= inner.peak_bytes
    assert clock.total().seconds == outer.seconds


def test_a_stage_that_fails_is_measured_too() -> None:
    clock = StageClock()
    with pytest.raises(ValueError, match="no"), clock.stage("failing"):
        raise ValueError("no")
    assert clock.stages[0].seconds > 0


def test_without_proc_the_peak_is_that_of_the_process(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(measuring, "_STATUS", tmp_path / "none")
    monkeypatch.setattr(measuring, "_CLEAR_REFS", tmp_path / "none" / "none")
    clock = StageClock()
    with clock.stage("only"):
        pass
    assert clock.stages[0].peak_bytes > 1_000_000
