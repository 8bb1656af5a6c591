# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

from hdpea.cli import run

# What tests start imports the helpers, too.
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(Path(__file__).parent), os.environ.get("PYTHONPATH")]))

# A busy machine must not fail a test; random examples are for people, repeatable ones for gates.
settings.register_profile("hdpea", deadline=None, derandomize=True)
settings.load_profile("hdpea")

# Whatever a shell runs in the background ignores Ctrl-C, and so do its children: those that tests start must not.
signal.signal(signal.SIGINT, signal.default_int_handler)
# Nor SIGHUP, as what nohup runs does.
signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.fixture
def failed(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """Return a function that runs a command and returns its error, having checked its exit code and manners."""

    def failed(exit_code: int, *arguments: str | Path) -> str:
        assert run([str(each) for each in arguments]) == exit_code
        error = capsys.readouterr().err
        assert "Traceback" not in error
        assert sum(line.startswith("Error: ") for line in error.splitlines()) == 1
        return error

    return failed
