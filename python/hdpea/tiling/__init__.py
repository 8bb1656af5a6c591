# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of clouds that are larger than memory: tile by tile, in tasks whose results are files.

A cloud is streamed into tiles with halos (``intake``). Each stage of a reconstruction is a task for each tile
(``tasks``); what tiles must agree on, a few tasks between these decide from what all of them found. Particles are
placed tile after tile, those of earlier neighbours fixed (``spreading``); the triangles of all tiles go through one
extraction (``joining``); the mesh is fitted and simplified tile after tile within a frozen rim (``finishing``).
"""
