# SPDX-License-Identifier: GPL-3.0-or-later
"""Writing meshes and clouds."""
