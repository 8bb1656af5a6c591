# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages as a browser shows them, on machines that have one."""

from __future__ import annotations

import re
import shutil
import subprocess
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
PATIENCE = 60.0
"""Seconds for a page that takes three: now and then Chromium never ends, and does the next time."""

WITHOUT_GPU = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


class Browser:
    """A headless Chromium, in a folder of its own."""

    def __init__(self, folder: Path) -> None:
        program = next(filter(None, map(shutil.which, BROWSERS)), None)
        if program is None:
            pytest.skip("there is no Chromium; on Debian: apt-get install chromium")
        self.folder = folder
        self.command = [program, "--headless", "--no-sandbox", *WITHOUT_GPU, f"--user-data-dir={folder / 'profile'}"]
        self.command += ["--enable-logging=stderr", "--window-size=800,600", "--virtual-time-budget=2000"]

    def drawn(self, page: Path, fragment: str = "") -> tuple[int, int]:
        """Return how many triangles and points a page draws; nothing may be said on its console."""
        url = f"{page.as_uri()}#{fragment}"
        made = self._run("--dump-dom", url)
        assert "CONSOLE" not in made.stderr
        body = re.search(r'<body data-triangles="(\d+)" data-points="(\d+)"', made.stdout)
        assert body is not None
        return int(body[1]), int(body[2])

    def picture(self, page: Path, fragment: str = "") -> NDArray[np.int64]:
        """Return the pixels (600, 800, 3) of a page."""
        from PIL import Image

        picture = self.folder / "screenshot.png"
        url = f"{page.as_uri()}#{fragment}"
        self._run(f"--screenshot={picture}", url)
        with Image.open(picture) as image:
            return np.asarray(image.convert("RGB"), dtype=int)

    def _run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        run = partial(subprocess.run, [*self.command, *arguments], capture_output=True, text=True, check=True)
        try:
            return run(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            return run(timeout=PATIENCE)
