# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of the ground truth: one dataclass per stage, as in ``hdpea.options``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from hdpea.errors import UnreadableInput
from hdpea.options import Checked, option
from hdpea.settings import RUN, as_dict, filled, settings


@dataclass(frozen=True)
class GroundTruthOptions(Checked):
    """How the true embedding of a mesh is made; lengths are shares of its bounding-box diagonal."""

    remesh_length: float = option(0.0075, "edge length of the triangles the embedding is solved on", minimum=0)
    curvature_radius: float = option(0.01, "radius in which curvature is measured", minimum=0)
    bending_length: float = option(0.006, "length below which the embedding does not bend", minimum=0)
    metric_scale: float = option(0.5, "c of the metric s^2 = c |k|: larger stretches more", minimum=0)
    max_stretch: float = option(8.0, "largest stretch of the metric in any direction", minimum=1)


@dataclass(frozen=True)
class SamplingOptions(Checked):
    """How points are drawn from a surface."""

    points: int = option(40_000, "points of a sample", minimum=1)
    method: str = option("area", "area or farthest", choices=("area", "farthest"))
    seed: int = option(0, "seed of everything random; the same seed gives the same bytes", minimum=0)


@dataclass(frozen=True)
class ScanOptions(Checked):
    """How a surface is scanned."""

    seed: int = option(0, "seed of everything random; the same seed gives the same bytes", minimum=0)


@dataclass(frozen=True)
class SampleOptions(Checked):
    """What a sample is made of."""

    kind: str = option(
        "area",
        "area: points at random, even by area; farthest: each far from the others; scan: as sensors see the surface",
        choices=("area", "farthest", "scan"),
    )
    estimate: bool = option(False, "add normals estimated from the points alone, for training on what scans have")
    augmented: bool = option(False, "write all ten augmentations, for a release; otherwise they are made on loading")


@dataclass(frozen=True)
class DatasetOptions(Checked):
    """Everything ``hdpea.dataset.building.build_dataset`` can be told; the manifest holds all but the run's own."""

    sample: SampleOptions = SampleOptions()
    sampling: SamplingOptions = SamplingOptions()
    scanning: ScanOptions = ScanOptions()
    ground_truth: GroundTruthOptions = GroundTruthOptions()
    jobs: int = option(0, "meshes at a time, which share the cores; 0: one for each core", minimum=0)
    time_limit: float = option(3600, "seconds after which a mesh is given up and skipped", minimum=0)


def manifest_options(options: DatasetOptions) -> dict[str, dict[str, Any]]:
    """Return all that the bytes of a dataset depend on, by stage and name; fit for JSON."""
    listed = as_dict(options)
    # How the work was shared out changes nothing; the method is the kind of the sample.
    del listed[RUN], listed["sampling"]["method"]
    return listed


def options_of_manifest(listed: Mapping[str, Mapping[str, Any]], **run: Any) -> DatasetOptions:
    """Return the options that ``manifest_options`` listed, and those of this run.

    Raises
    ------
    UnreadableInput
        If they are not the options of this version of hdpea.
    """
    values = {name: value for stage in listed.values() for name, value in stage.items()}
    unknown = set(values) - {each.name for each in settings(DatasetOptions)}
    if unknown:
        raise UnreadableInput(f"The manifest has an unknown option {min(unknown)!r}.", "Use the hdpea it names.")
    return filled(DatasetOptions, {**values, **run})
