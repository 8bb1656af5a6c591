# SPDX-License-Identifier: GPL-3.0-or-later
"""The file that was probably meant, where there is none of the name that was typed."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path

ALIKE = 0.75
"""Least similarity of two names, by ``difflib``, of which one may be meant by the other."""


def nearest_name(path: Path) -> Path | None:
    """Return the file of the same folder whose name is most like that of `path`; None if none is like it.

    One that differs in capitals, or lacks its extension, is the most like it.
    """
    try:
        names = sorted(each.name for each in path.parent.iterdir() if each.is_file())
    except OSError:
        return None
    wanted = path.name.lower()
    for name in names:
        if wanted in {name.lower(), Path(name).stem.lower()}:
            return path.parent / name
    return next((path.parent / near for near in get_close_matches(path.name, names, 1, ALIKE)), None)
