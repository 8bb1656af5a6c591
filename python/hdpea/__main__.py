# SPDX-License-Identifier: GPL-3.0-or-later
"""``python -m hdpea`` is the same as ``hdpea``."""

from __future__ import annotations

from hdpea.cli import main

main()
