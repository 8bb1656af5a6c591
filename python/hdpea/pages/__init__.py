# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages that show meshes and points in a browser."""
