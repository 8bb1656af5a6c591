# SPDX-License-Identifier: GPL-3.0-or-later
"""The training loop."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from hdpea.errors import Interrupted
from hdpea.network.options import NetworkOptions
from hdpea.runtime.threads import limited_threads
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.crops import Crop, Samples
from hdpea.training.joined import require_same_metric
from hdpea.training.journal import LAST, Journal
from hdpea.training.options import TrainingOptions
from hdpea.training.steps import Training
from hdpea.training.workers import Workers


def train(
    samples: Samples,
    validation: Samples | None,
    out: Path,
    network: NetworkOptions,
    options: TrainingOptions,
    stopped: Callable[[], bool] = lambda: False,
    workers: Workers | None = None,
    board: bool = False,
    tell: Callable[[str], None] = lambda _: None,
) -> Training:
    """Train a network, or resume the training whose last checkpoint is in the folder `out`.

    Parameters
    ----------
    samples, validation
        The training set, and the set of which clouds are reconstructed at intervals to choose the best weights.
    out
        A folder for ``last.pt``, ``best.pt``, ``best.safetensors`` and ``metrics.jsonl``.
    stopped
        Called between steps; True ends the training with a checkpoint and ``Interrupted``.
    workers
        The rank of this process among those that train together; only the first writes.
    board
        Whether to write for TensorBoard as well.
    tell
        Called with each line of the journal.

    Raises
    ------
    UsageError
        If the validation set has another metric than the samples, or a checkpoint in `out` is of other options.
    UnreadableInput
        If that checkpoint cannot be read.
    Interrupted
        If `stopped` returned True.
    """
    if validation is not None:
        require_same_metric(samples, validation, "the validation set")
    with limited_threads(options.threads):
        training = Training(samples, network, options, workers)
        if (out / LAST).exists():
            training.resume(Checkpoint.read(out / LAST))
        _run(training, validation, Journal(training, out, board, tell), stopped)
    return training


def _run(training: Training, validation: Samples | None, journal: Journal, stopped: Callable[[], bool]) -> None:
    options, saved = training.options, time.monotonic()
    for crop in _prefetched(training):
        journal.add(training.run_step(crop))
        ended = training.step == training.steps
        if training.step % options.log_every == 0:
            journal.write_means()
        if validation is not None and (training.step % options.validate_every == 0 or ended):
            journal.validate(validation)
        # All processes end when one of them is asked to.
        ending = training.workers.mean({"ending": float(stopped())})["ending"] > 0
        if ending or ended or time.monotonic() - saved > 60 * options.save_minutes:
            journal.save(LAST)
            saved = time.monotonic()
        if ending:
            raise Interrupted


def _prefetched(training: Training) -> Iterator[Crop]:
    """Yield the crops of all remaining steps, each cut while the network trains on the one before."""
    with ThreadPoolExecutor(1) as pool:
        following = pool.submit(training.crop, training.step)
        for step in range(training.step, training.steps):
            crop = following.result()
            if step + 1 < training.steps:
                following = pool.submit(training.crop, step + 1)
            yield crop
