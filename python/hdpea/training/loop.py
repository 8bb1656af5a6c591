# SPDX-License-Identifier: GPL-3.0-or-later
"""The training loop."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from hdpea.errors import Interrupted
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.runtime.threads import limited_threads
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.crops import Samples
from hdpea.training.joined import require_same_metric
from hdpea.training.journal import LAST, Journal
from hdpea.training.loaders import prefetched
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
    start: PointTransformer | None = None,
    clock: Callable[[], float] = time.monotonic,
) -> Training:
    """Train a network, or resume the training whose last checkpoint is in the folder `out`.

    Parameters
    ----------
    samples, validation
        The training set, and the set of which clouds are reconstructed at intervals to choose the best weights.
    out
        A folder for ``last.pt``, ``best.pt``, their averaged weights (``.safetensors``) and ``metrics.jsonl``.
    stopped
        Called between steps; True ends the training with a checkpoint and ``Interrupted``.
    workers
        The rank of this process among those that train together; only the first writes.
    board
        Whether to write for TensorBoard as well.
    tell
        Called with each line of the journal.
    start
        A trained network whose weights to start from, unless there is a training to resume.
    clock
        Tells seconds, by which a training of so many minutes goes.

    Raises
    ------
    UsageError
        If the validation set or `start` has another metric than the samples, a checkpoint in `out` is of other options,
        or there is no such device.
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
        elif start is not None:
            training.start_from(start)
        _run(training, validation, Journal(training, out, board, tell), stopped, clock)
    return training


def _run(
    training: Training,
    validation: Samples | None,
    journal: Journal,
    stopped: Callable[[], bool],
    clock: Callable[[], float],
) -> None:
    options, began = training.options, clock() - training.seconds
    saved = training.seconds
    for crop in prefetched(training.crops, training.step, training.steps):
        journal.add(training.run_step(crop))
        # All processes end when one of them is asked to, and go by one clock.
        shared = training.workers.mean({"ending": float(stopped()), "seconds": clock() - began})
        spent, ending = shared["seconds"], shared["ending"] > 0
        if options.minutes is not None:
            training.seconds = spent
        ended = training.done == 1
        if training.step % options.log_every == 0:
            journal.write_means()
        if validation is not None and (training.step % options.validate_every == 0 or ended):
            journal.validate(validation)
        if ending or ended or spent - saved > 60 * options.save_minutes:
            journal.save()
            saved = spent
        if ending:
            raise Interrupted
        if ended:
            return
