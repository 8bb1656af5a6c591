# SPDX-License-Identifier: GPL-3.0-or-later
"""Provenance of results: version, commit, machine and day."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
from collections.abc import Iterable
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from hdpea.version import version

HERE = Path(__file__).parent


def provenance(codes: Iterable[str]) -> str:
    """Return the distinct versions of the code that did the runs (see ``code``), the machine and the day."""
    cores, day = os.cpu_count(), datetime.now(UTC).date().isoformat()
    known = " and ".join(each for each in dict.fromkeys(codes) if each)
    return f"{known or code()}, {platform.system()} {platform.machine()}, {cores} cores, {day}"


@cache
def code() -> str:
    """Return the version, and the commit if this is a checkout of hdpea."""
    built_from = commit()
    return f"hdpea {version()}" + (f" (commit {built_from})" if built_from else "")


def commit() -> str:
    """Return the commit of the checkout this runs from, with ``+`` if files have changed; empty without one."""
    git = shutil.which("git")
    if git is None or not (Path(_output_of(git, "rev-parse", "--show-toplevel")) / "python/hdpea/version.py").is_file():
        return ""
    return _output_of(git, "rev-parse", "--short", "HEAD") + ("+" if _output_of(git, "status", "--porcelain") else "")


def _output_of(git: str, *command: str) -> str:
    made = subprocess.run([git, "-C", str(HERE), *command], capture_output=True, text=True, check=False)  # noqa: S603
    return made.stdout.strip() if made.returncode == 0 else ""
