# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a dataset as its manifest records them: written and read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hdpea.dataset.options import DatasetOptions
from hdpea.errors import UnreadableInput
from hdpea.options.settings import RUN, as_dict


def options_for_manifest(options: DatasetOptions) -> dict[str, dict[str, Any]]:
    """Return all options that the bytes of a dataset depend on, by stage and name, for JSON."""
    listed = as_dict(options)
    # The options of the run do not affect the bytes, and the method of sampling is the kind of the sample.
    del listed[RUN], listed["sampling"]["method"]
    stages = ("sample", options.source_of_points, "ground_truth")
    return {stage: listed[stage] for stage in stages}


def options_from_manifest(listed: Mapping[str, Mapping[str, Any]], **run: Any) -> DatasetOptions:
    """Return the options that ``options_for_manifest`` recorded, together with those of this run.

    Raises
    ------
    UnreadableInput
        If they are not the options of this version of hdpea.
    """
    try:
        stages = {stage: type(getattr(DatasetOptions, stage))(**values) for stage, values in listed.items()}
    except (AttributeError, TypeError) as error:
        raise UnreadableInput(f"The manifest has an unknown option ({error}).", "Use the hdpea it names.") from error
    return DatasetOptions(**stages, **run)
