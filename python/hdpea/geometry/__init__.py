# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames, triangles, tensors and metrics: what knows no stage."""
