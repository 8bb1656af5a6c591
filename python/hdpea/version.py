# SPDX-License-Identifier: GPL-3.0-or-later
"""The version, whose one home is pyproject.toml, and what the package was built from and with."""

from __future__ import annotations

from pathlib import Path

UNKNOWN = "unknown"
"""The version of what is not installed."""

BUILD = Path(__file__).with_name("build.json")
"""Written when the core is compiled; there is none in a source tree that is not installed."""


def version(package: str = "hdpea") -> str:
    """Return the version of an installed package, or ``UNKNOWN`` if it is not installed."""
    from importlib import metadata

    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return UNKNOWN


def described() -> list[str]:
    """Return version, commit, what runs it and what is compiled in, a line each: what a report of an error needs."""
    import json
    import platform

    built = json.loads(BUILD.read_text(encoding="utf-8")) if BUILD.is_file() else {}
    first = f"hdpea {version()}" + (f" (commit {built['commit']})" if built.get("commit") else "")
    running = [f"{name} {version(name)}" for name in ("numpy", "torch") if version(name) != UNKNOWN]
    lines = [first, f"runs on Python {platform.python_version()}, {', '.join(running)}, {platform.platform()}"]
    if built:
        libraries = ", ".join(f"{name} {which}".strip() for name, which in built["libraries"].items())
        lines.append(f"compiled by {built['compiler']} with {libraries}")
    return lines
