# SPDX-License-Identifier: GPL-3.0-or-later
"""Axes that may be up."""

from __future__ import annotations

UP_AXES = ("z", "y", "-y")
"""z where people measure, y where they draw, -y before a depth camera."""
