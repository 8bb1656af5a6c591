# SPDX-License-Identifier: GPL-3.0-or-later
"""How small groups of points are spread about their middles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def covariances(groups: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the covariances (m, d, d) of groups of points (m, k, d).

    Examples
    --------
    >>> import numpy as np
    >>> covariances(np.array([[[0.0, 0], [2, 0], [0, 4], [2, 4]]]))
    array([[[1., 0.],
            [0., 4.]]])
    """
    offsets = groups - groups.mean(axis=1, keepdims=True)
    return np.asarray(offsets.swapaxes(1, 2) @ offsets / groups.shape[1])


def relative_covariances(groups: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the same, relative to the variance along a random direction; 0 where all points of a group are equal."""
    spread = covariances(groups)
    mean = np.trace(spread, axis1=1, axis2=2) / groups.shape[2]
    return np.asarray(spread / np.where(mean > 0, mean, 1)[:, None, None])
