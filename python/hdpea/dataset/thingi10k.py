# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of Thingi10K (Zhou and Jacobson 2016), by the package of that name, which downloads and caches them."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from hdpea.dataset.sources import UNSTATED, Source
from hdpea.errors import UnreadableInput, UsageError

THINGI10K = "thingi10k:"
"""What the name of a model begins with; its file ID follows."""


def find_models(ids: str) -> list[Source]:
    """Return the models of the given file IDs, such as ``34785,36371``, ordered by ID.

    Raises
    ------
    UsageError
        If these are not IDs, there are no such models, or the package ``thingi10k`` is not installed.
    UnreadableInput
        If the models can be neither downloaded nor found in its cache.
    """
    try:
        wanted = sorted({int(each) for each in ids.split(",")})
    except ValueError as error:
        raise UsageError(f"{ids!r} are not IDs of Thingi10K.", f"As in: {THINGI10K}34785,36371") from error
    if find_spec("thingi10k") is None:
        raise UsageError(
            "Thingi10K cannot be read: the package thingi10k is not installed.", "pip install 'hdpea[thingi10k]'"
        )
    import thingi10k

    try:
        thingi10k.init()
        entries = {entry["file_id"]: entry for entry in thingi10k.dataset(file_id=wanted)}
    except (RuntimeError, OSError) as error:
        hint = "Its first use downloads some gigabytes: is there a network, and room on the disk?"
        raise UnreadableInput(f"Thingi10K cannot be downloaded or read: {error}.", hint) from error
    missing = [each for each in wanted if each not in entries]
    if missing:
        raise UsageError(
            f"Thingi10K has no model {', '.join(map(str, missing))}.", "https://ten-thousand-models.appspot.com"
        )
    return [
        Source(
            name=f"thingi10k_{each}",
            source=f"{THINGI10K}{each}",
            path=Path(entries[each]["file_path"]),
            origin=_origin(entries[each]),
            licence=entries[each]["license"] or UNSTATED,
        )
        for each in wanted
    ]


def _origin(entry: dict[str, object]) -> str:
    return f"thingiverse.com/thing:{entry['thing_id']}: {entry['name']} by {entry['author']}"
