# SPDX-License-Identifier: GPL-3.0-or-later
"""The version, whose one home is pyproject.toml."""

from __future__ import annotations


def version() -> str:
    """Return the version of the installed package, or ``unknown`` in a source tree that is not installed."""
    from importlib import metadata

    try:
        return metadata.version("hdpea")
    except metadata.PackageNotFoundError:
        return "unknown"
