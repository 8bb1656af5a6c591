# SPDX-License-Identifier: GPL-3.0-or-later
"""Several datasets as one: clean clouds beside simulated scans."""

from __future__ import annotations

from collections.abc import Sequence

from hdpea.dataset.sample import Sample
from hdpea.training.crops import Samples


class Joined:
    """The samples of several datasets, one dataset after the other; names say which, since two may share one."""

    def __init__(self, datasets: Sequence[Samples]) -> None:
        self._homes = {f"{number}/{name}": (each, name) for number, each in enumerate(datasets) for name in each.names}

    @property
    def names(self) -> list[str]:
        """The names, with the number of their dataset."""
        return list(self._homes)

    def read(self, name: str) -> Sample:
        """Read one."""
        dataset, own_name = self._homes[name]
        return dataset.read(own_name)

    def spacing(self, name: str) -> float:
        """Return the unit of the lengths of its ground truth, in unit length."""
        dataset, own_name = self._homes[name]
        return dataset.spacing(own_name)
