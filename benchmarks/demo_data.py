# SPDX-License-Identifier: GPL-3.0-or-later
"""The clouds and models of Debian's libcgal-demo, which anybody can have: `apt-get install libcgal-demo`."""

from __future__ import annotations

import tarfile
from collections.abc import Sequence
from pathlib import Path

import click

ARCHIVE = Path("/usr/share/doc/libcgal-dev/data.tar.gz")
"""Where Debian has them, as `make demo` knows."""

CLOUDS, MODELS = "points_3", "meshes"


def demo_files(out: Path, kind: str, names: Sequence[str] = ()) -> list[Path]:
    """Unpack files of a kind, ``CLOUDS`` or ``MODELS``, into `out`, and return their paths in the order of `names`.

    Without names these are all, by their names.
    """
    if not ARCHIVE.exists():
        raise click.UsageError("libcgal-demo is not installed: apt-get install libcgal-demo")
    out.mkdir(parents=True, exist_ok=True)
    found = {}
    with tarfile.open(ARCHIVE) as archive:
        for member in archive:
            name = Path(member.name).name
            if member.isfile() and member.name.startswith(f"data/{kind}/") and (not names or name in names):
                member.name = name
                archive.extract(member, out, filter="data")
                found[name] = out / name
    return [found[name] for name in names or sorted(found)]
