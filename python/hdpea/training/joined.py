# SPDX-License-Identifier: GPL-3.0-or-later
"""Several datasets as one, such as clean clouds and simulated scans."""

from __future__ import annotations

from collections.abc import Sequence

from hdpea.dataset.sample import Sample
from hdpea.errors import UsageError
from hdpea.geometry.metric import ScaledMetric
from hdpea.training.crops import Samples


class Joined:
    """The samples of several datasets, one after the other; a number makes equal names unique.

    Raises
    ------
    UsageError
        If their ground truths have different metrics.
    """

    def __init__(self, datasets: Sequence[Samples]) -> None:
        for other in datasets[1:]:
            require_same_metric(datasets[0], other, "another dataset to train on")
        self._metric = datasets[0].metric
        self._homes = {f"{number}/{name}": (each, name) for number, each in enumerate(datasets) for name in each.names}

    @property
    def names(self) -> list[str]:
        """The names, each after the number of its dataset."""
        return list(self._homes)

    @property
    def metric(self) -> ScaledMetric:
        """The metric of all of them."""
        return self._metric

    def read(self, name: str) -> Sample:
        """Read a sample."""
        dataset, own_name = self._homes[name]
        return dataset.read(own_name)

    def spacing(self, name: str) -> float:
        """Return the unit of the lengths of its ground truth, in unit length."""
        dataset, own_name = self._homes[name]
        return dataset.spacing(own_name)


def require_same_metric(samples: Samples, others: Samples, what: str) -> None:
    """Refuse `others`, which are `what`, unless the metric of their ground truth is that of the samples.

    Raises
    ------
    UsageError
        If it is another.
    """
    if others.metric != samples.metric:
        raise UsageError(
            f"The metric of {what} differs: {others.metric} instead of {samples.metric}.",
            "Build both datasets with the same options of the ground truth.",
        )
