# SPDX-License-Identifier: GPL-3.0-or-later
"""Datasets packed to train on: one file, 22 to 34 bytes a point, of which a sample is read in a millisecond.

It travels to where the training runs, and holds what a training looks at: no curvatures and no sensors. Coordinates are
whole numbers of 16 bits between the least and the most of their column; of a surface 100 spacings across, a step is
0.002 of one. The points are in an order of space, so that those of a crop lie side by side in memory.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file

from hdpea.dataset.sample import Sample
from hdpea.errors import UnreadableInput
from hdpea.geometry.metric import ScaledMetric
from hdpea.geometry.spatial_order import spatial_order
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import replacing
from hdpea.training.crops import Samples

FORMAT = "1"
"""Counts up whenever the meaning of the file changes."""

PACKED_FORMATS = (".safetensors",)

KIND = "packed dataset"
"""What such a file is marked as."""

COLUMNS = {"points": 3, "normals": 3, "psi": 5, "surface_points": 3, "estimated_normals": 3}
"""Columns of each array of a sample; the last two only where they differ from others, or are there at all."""

STEPS = 2**16 - 1


def write_packed(path: Path, samples: Samples) -> None:
    """Pack all samples, whole or not at all."""
    arrays: dict[str, NDArray[np.uint16]] = {}
    described: dict[str, dict[str, Any]] = {}
    for name in samples.names:
        sample = samples.read(name)
        order = spatial_order(sample.points)
        ranges: dict[str, list[list[float]]] = {}
        for each in COLUMNS:
            column = getattr(sample, each)
            if column is None or (each == "surface_points" and np.array_equal(column, sample.points)):
                continue
            low, high = column.min(axis=0).astype(np.float64), column.max(axis=0).astype(np.float64)
            share = (column[order] - low) / np.where(high > low, high - low, 1)
            arrays[f"{name}/{each}"] = np.rint(STEPS * share).astype(np.uint16)
            ranges[each] = [low.tolist(), high.tolist()]
        described[name] = {"spacing": samples.spacing(name), "ranges": ranges}
    metric = {name: getattr(samples.metric, name) for name in samples.metric.__dataclass_fields__}
    # The mark first: metadata come in any order, and the rest of the content may be long.
    content = {"generator": mark_of(KIND), "metric": metric, "samples": described}
    with replacing(path) as partial:
        save_file(arrays, partial, {"hdpea_packed": FORMAT, "content": json.dumps(content)})


class Packed:
    """The samples of a file that ``hdpea dataset pack`` made.

    Raises
    ------
    UnreadableInput
        If it is missing, damaged, or no such file.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        hint = "Such a file is what `hdpea dataset pack` writes."
        try:
            with safe_open(path, framework="numpy") as file:
                metadata = file.metadata() or {}
            if metadata.get("hdpea_packed") != FORMAT:
                raise UnreadableInput(f"{path} holds no packed samples, or those of another version.", hint)
            content = json.loads(metadata["content"])
            self._metric = ScaledMetric.of_record(content["metric"])
            self._samples: dict[str, dict[str, Any]] = dict(content["samples"])
        except (OSError, SafetensorError, LookupError, ValueError, TypeError) as error:
            raise UnreadableInput(f"Cannot read {path}: {error}.", hint) from error

    @property
    def names(self) -> Sequence[str]:
        """The names of the samples, in the order in which they were packed."""
        return list(self._samples)

    @property
    def metric(self) -> ScaledMetric:
        """The metric of their ground truth, in spacings."""
        return self._metric

    def spacing(self, name: str) -> float:
        """Return the unit of the lengths of its ground truth, in unit length."""
        return float(self._samples[name]["spacing"])

    def read(self, name: str) -> Sample:
        """Return a sample to the precision of the file; curvatures, which are not in it, are not numbers."""
        arrays: dict[str, NDArray[np.float32]] = {}
        # Opened again each time, so that it can be read in other processes; nothing but its header is read twice.
        with safe_open(self.path, framework="numpy") as file:
            for each, (low, high) in self._samples[name]["ranges"].items():
                column = file.get_tensor(f"{name}/{each}").astype(np.float32)
                column *= ((np.array(high) - low) / STEPS).astype(np.float32)
                column += np.float32(low)
                arrays[each] = column
        unknown = np.full((1, 3), np.nan, np.float32)
        count = len(arrays["points"])
        return Sample(
            points=arrays["points"],
            surface_points=arrays.get("surface_points", arrays["points"]),
            normals=arrays["normals"],
            psi=arrays["psi"],
            curvatures=np.broadcast_to(unknown[:, :2], (count, 2)),
            direction1=np.broadcast_to(unknown, (count, 3)),
            frame=UnitFrame(np.zeros(3), 1.0),
            estimated_normals=arrays.get("estimated_normals"),
        )
