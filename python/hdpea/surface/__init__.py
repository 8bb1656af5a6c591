# SPDX-License-Identifier: GPL-3.0-or-later
"""From a cleaned cloud to an oriented surface: neighbours, roughness, normals, orientation, denoising."""
