# SPDX-License-Identifier: GPL-3.0-or-later
"""The curvature metric: stretches and back, its unit, and what a file may say of it."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np
import pytest

from hdpea.dataset.options import GroundTruthOptions
from hdpea.geometry.metric import Metric, ScaledMetric
from hdpea.options.embedding import BENDING_LENGTH, CURVATURE_RADIUS

METRIC = ScaledMetric(scale=40.0, max_stretch=6.0, bending_length=0.6, curvature_radius=1.2)


def test_stretches_are_clamped_and_tell_curvatures_between_the_ends() -> None:
    metric = Metric(scale=0.5, max_stretch=8)
    low, high = metric.curvature_range
    curvatures = np.array([0, -low, 10, -high, 10 * high])
    np.testing.assert_allclose(metric.stretches(curvatures), [1, 1, 5**0.5, 8, 8])
    np.testing.assert_allclose(metric.curvatures(metric.stretches(curvatures)), [low, low, 10, high, high])


def test_the_unit_changes_lengths_and_no_stretch() -> None:
    in_unit = METRIC.at(0.01)
    assert asdict(in_unit) == pytest.approx(
        {"scale": 0.4, "max_stretch": 6.0, "bending_length": 0.006, "curvature_radius": 0.012}
    )
    curvatures = np.linspace(0, 2, 9)
    np.testing.assert_allclose(in_unit.stretches(curvatures / 0.01), METRIC.stretches(curvatures))


def test_the_solver_gets_every_number() -> None:
    options = METRIC.solver()
    assert (options.metric_scale, options.max_stretch, options.bending_length) == (40.0, 6.0, 0.6)


def test_the_ground_truth_has_the_lengths_of_all_embeddings_but_its_radius() -> None:
    truth = GroundTruthOptions().metric
    assert truth.bending_length == BENDING_LENGTH
    assert truth.of_clouds() == ScaledMetric(truth.scale, truth.max_stretch, truth.bending_length, CURVATURE_RADIUS)


def test_a_record_comes_back() -> None:
    assert ScaledMetric.of_record(asdict(METRIC)) == METRIC


@pytest.mark.parametrize(
    "record",
    [
        None,
        [],
        {},
        {"scale": 40.0},
        asdict(METRIC) | {"further": 1.0},
        *(
            asdict(METRIC) | {"scale": value}
            for value in (0, -1.0, float("nan"), float("inf"), 10**400, "40", None, True)
        ),
        asdict(METRIC) | {"max_stretch": 0.5},
        asdict(METRIC) | {"bending_length": -0.1},
        asdict(METRIC) | {"curvature_radius": 0.0},
    ],
)
def test_a_record_of_no_metric_is_refused(record: Any) -> None:
    with pytest.raises(ValueError, match="metric"):
        ScaledMetric.of_record(record)
