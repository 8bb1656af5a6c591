# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors of raw points: see ``hdpea.curvature.estimation``."""
