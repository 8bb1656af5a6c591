# SPDX-License-Identifier: GPL-3.0-or-later
"""From an embedded surface to a mesh: particles, cells, extraction, refinement, simplification."""
