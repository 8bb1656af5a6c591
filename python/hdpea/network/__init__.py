# SPDX-License-Identifier: GPL-3.0-or-later
"""The learned embedding: Point Transformer V3 in plain PyTorch, from points and normals to psi."""
