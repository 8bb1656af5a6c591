# SPDX-License-Identifier: GPL-3.0-or-later
"""Compact anisotropic triangle meshes from raw point clouds."""
