# SPDX-License-Identifier: GPL-3.0-or-later
"""How good a mesh is, measured against the true surface: one definition of every score, used everywhere."""
