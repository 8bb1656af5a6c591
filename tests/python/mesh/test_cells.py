# SPDX-License-Identifier: GPL-3.0-or-later
"""Restricted cells, where particles are not spread as they should be."""

from __future__ import annotations

import numpy as np
from helpers import clouds

from hdpea import _core
from hdpea.mesh.cells import restricted_cells


def test_particles_in_one_place_have_cells() -> None:
    points, normals = (np.vstack([array, np.repeat(array[:1], 7, axis=0)]) for array in clouds.sphere(300))
    bases = _core.tangent_bases_across(normals).reshape(-1, 2, 3)
    candidates, radii = restricted_cells(points, bases, 1.8)
    assert (radii > 0).all()
    assert np.isfinite(candidates.cell_areas).all()
    assert len(candidates.triangles) > 500
