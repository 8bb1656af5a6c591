# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from hypothesis import settings

# A busy machine must not fail a test; random examples are for people, repeatable ones for gates.
settings.register_profile("hdpea", deadline=None, derandomize=True)
settings.load_profile("hdpea")
