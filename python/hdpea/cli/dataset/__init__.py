# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset COMMAND``: points of known surfaces, to train on and to measure with."""

from __future__ import annotations

import click

from hdpea.cli.lazy import lazy_group

COMMANDS = ("build", "scan", "degrade", "info", "show", "pack")

EPILOG = """\b
Begin with:
  hdpea dataset build meshes/ samples/
  hdpea dataset info samples/
  hdpea dataset show samples/samples/bunny.npz bunny.png
"""


@click.group(cls=lazy_group("hdpea.cli.dataset", COMMANDS), epilog=EPILOG, short_help="Make points with known truth.")
def command() -> None:
    """Points of known surfaces, each with its true embedding, curvature and normal.

    A sample is one NPZ file; a dataset is a folder of them with a manifest, from which it can be
    built again, byte for byte.
    """
