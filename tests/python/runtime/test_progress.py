# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import re
from contextlib import suppress

import numpy as np
import pytest
from helpers import clouds

from hdpea import reconstruct
from hdpea.errors import Interrupted
from hdpea.runtime.progress import of_phase, shown, tell


def run_two_phases(quiet: bool = False) -> None:
    with shown(quiet) as progress:
        for phase in ("embedding", "meshing"):
            for fraction in (0.0, 0.5, 1.0):
                tell(progress, phase, fraction)


def test_plain_progress_is_a_line_per_phase(capsys: pytest.CaptureFixture[str]) -> None:
    run_two_phases()
    assert re.fullmatch(r"embedding \.\.\. \d+\.\d s\nmeshing \.\.\. \d+\.\d s\n", capsys.readouterr().err)


def test_quiet_progress_is_silent(capsys: pytest.CaptureFixture[str]) -> None:
    run_two_phases(quiet=True)
    assert capsys.readouterr() == ("", "")


def test_a_terminal_sees_bars(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm")
    run_two_phases()
    shown_text = capsys.readouterr().err
    assert "embedding" in shown_text
    assert "100%" in shown_text


def test_a_line_is_ended_when_a_phase_fails(capsys: pytest.CaptureFixture[str]) -> None:
    with suppress(ValueError), shown() as progress:
        tell(progress, "embedding", 0.0)
        raise ValueError("no")
    assert capsys.readouterr().err.endswith(" s\n")


def test_a_callback_that_says_no_stops_the_run() -> None:
    with pytest.raises(Interrupted):
        tell(lambda _phase, _fraction: False, "embedding", 0.5)


def test_the_core_gets_a_callback_of_the_fraction_alone() -> None:
    seen: list[tuple[str, float]] = []

    def progress(phase: str, fraction: float) -> bool:
        seen.append((phase, fraction))
        return fraction < 0.5

    callback = of_phase(progress, "meshing")
    assert [callback(0.25), callback(0.75)] == [True, False]
    assert seen == [("meshing", 0.25), ("meshing", 0.75)]
    assert of_phase(None, "meshing")(0.5)


@pytest.mark.parametrize("answer", [True, 1, None, np.bool_(True), "yes"])
def test_any_answer_but_a_false_one_goes_on(answer: object) -> None:
    tell(lambda *_: answer, "meshing", 0.5)
    assert reconstruct(clouds.sphere(200)[0], progress=lambda *_: answer, vertices=30).report.mesh.closed


@pytest.mark.parametrize("answer", [False, 0, np.bool_(False)])
def test_a_false_answer_interrupts(answer: object) -> None:
    with pytest.raises(Interrupted):
        reconstruct(clouds.sphere(200)[0], progress=lambda *_: answer, vertices=30)
