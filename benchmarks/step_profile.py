# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a step of training spends its time: the cutting of crops by parts, and the operations of PyTorch.

    python benchmarks/step_profile.py PACKED [--device cuda] [--batch 24] [--steps 20]

PACKED is a file of `hdpea dataset pack`. Prints Markdown.
"""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import patch

import click
import torch
from torch.profiler import ProfilerActivity, profile

from hdpea import _core
from hdpea.network.options import CONFIGURATIONS
from hdpea.runtime.threads import limited_threads
from hdpea.training.options import PRESETS
from hdpea.training.packed import Packed
from hdpea.training.steps import Training

SHOWN = 10
PARTS = ("nearest_neighbors", "sheet_neighbors", "estimate_curvature")


def timed(function: Callable[..., Any], name: str, spent: dict[str, float]) -> Callable[..., Any]:
    """Return the function, its CPU time added to `spent` under `name`."""

    def call(*arguments: Any) -> Any:
        began = time.process_time()
        try:
            return function(*arguments)
        finally:
            spent[name] += time.process_time() - began

    return call


def print_crops(training: Training, steps: int) -> None:
    """Print the milliseconds of CPU time in which a crop is cut, and of its parts."""
    spent: dict[str, float] = defaultdict(float)
    samples = type(training.crops.samples)
    patches = [patch.object(_core, name, timed(getattr(_core, name), name, spent)) for name in PARTS]
    patches += [patch.object(samples, "read", timed(samples.read, "reading the sample", spent))]
    for each in patches:
        each.start()
    began = time.process_time()
    for step in range(steps):
        training.crops[step]
    total = time.process_time() - began
    patch.stopall()
    count = steps * training.options.batch
    click.echo("| cutting a crop | ms |\n|---|---|")
    for name, seconds in sorted(spent.items(), key=lambda each: -each[1]):
        click.echo(f"| {name} | {1e3 * seconds / count:.1f} |")
    click.echo(f"| all | {1e3 * total / count:.1f} |\n")


def print_step(training: Training, steps: int) -> None:
    """Print the share of each operation of PyTorch in forward, loss, backward and optimizer."""
    on_gpu = training.workers.device.type == "cuda"
    crops = [training.crops[step] for step in range(steps)]
    training.run_step(crops[0])
    activities = [ProfilerActivity.CPU, *[ProfilerActivity.CUDA] * on_gpu]
    with profile(activities=activities) as profiler:
        began = time.perf_counter()
        for crop in crops:
            training.run_step(crop)
        seconds = (time.perf_counter() - began) / steps
    own = {each.key: each.self_device_time_total if on_gpu else each.self_cpu_time_total
           for each in profiler.key_averages()}  # fmt: skip
    total = sum(own.values())
    click.echo(f"| operation, {training.workers.device}, {1e3 * seconds:.0f} ms a step | share |\n|---|---|")
    for name, spent in sorted(own.items(), key=lambda each: -each[1])[:SHOWN]:
        click.echo(f"| `{name}` | {spent / total:.0%} |")


@click.command()
@click.argument("packed", type=click.Path(exists=True, path_type=Path))
@click.option("--device", default="cpu", show_default=True)
@click.option("--batch", default=1, show_default=True)
@click.option("--steps", default=20, show_default=True)
def main(packed: Path, device: str, batch: int, steps: int) -> None:
    """Print both tables."""
    torch.set_num_threads(1)
    options = replace(PRESETS["cpu"], device=device, batch=batch)
    with limited_threads(1):
        training = Training(Packed(packed), CONFIGURATIONS["compact"], options)
        print_crops(training, steps)
        print_step(training, steps)


if __name__ == "__main__":
    main()
