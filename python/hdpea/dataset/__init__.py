# SPDX-License-Identifier: GPL-3.0-or-later
"""Ground truth: clouds of known surfaces, with their true embedding, curvature and normals."""
