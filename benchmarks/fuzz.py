# SPDX-License-Identifier: GPL-3.0-or-later
"""Random clouds, files, commands and calls of the core: whatever comes, a true mesh or a documented error.

    make fuzz [CLOUDS=10000] [FILES=5000] [COMMANDS=2000] [CORE=5000] [SEED=0] [MINUTES=600]

Each case is known by its kind and seed, and runs in a worker process with limits of time and memory, so that a crash
is one failure of many. Failures are listed with the command that repeats one; any of them ends the script with exit
code 1. docs/robustness.md says what is tried, and what has to hold.
"""

from __future__ import annotations

import resource
import sys
import time
from collections import Counter
from collections.abc import Iterator

import click
from helpers.fuzzing import clouds, commands, core, files

from hdpea.runtime.processes import run_isolated

SECONDS, GIGABYTES = 120, 6
"""Limits of one case."""

KINDS = {"clouds": clouds.run, "files": files.run, "commands": commands.run, "core": core.run}

Case = tuple[str, int]


def run_case(case: Case) -> str:
    """Run one case under the limits; return how it ended."""
    kind, seed = case
    resource.setrlimit(resource.RLIMIT_AS, (GIGABYTES << 30, GIGABYTES << 30))
    return KINDS[kind](seed)


@click.command()
@click.option("--clouds", default=10_000, show_default=True, help="random clouds")
@click.option("--files", default=5_000, show_default=True, help="damaged files")
@click.option("--commands", default=2_000, show_default=True, help="commands, on good and damaged files")
@click.option("--core", default=5_000, show_default=True, help="calls of functions of the core")
@click.option("--seed", default=0, show_default=True, help="of the first case of each; the others count up from it")
@click.option("--jobs", default=2, show_default=True, help="processes")
@click.option("--minutes", default=600.0, show_default=True, help="when to stop, whatever is left")
@click.option("--one", type=click.Choice(list(KINDS)), help="run the one case of this kind and seed, here")
def main(*, seed: int, jobs: int, minutes: float, one: str | None, **counts: int) -> None:
    """Fuzz hdpea."""
    if one:
        print(run_case((one, seed)))
        return
    stop = time.monotonic() + 60 * minutes
    cases = [(kind, seed + each) for kind, count in counts.items() for each in range(count)]
    outcomes, failures = Counter[tuple[str, str]](), list[tuple[Case, str]]()
    for done, outcome in enumerate(run_isolated(run_case, cases, jobs, SECONDS), start=1):
        case = cases[outcome.index]
        if outcome.failed:
            failures.append((case, " ".join(outcome.failed.split())))
            print(f"{_command(case)}   # {failures[-1][1]}", flush=True)
        outcomes[case[0], "FAILED" if outcome.failed else str(outcome.result)] += 1
        if done % 1_000 == 0:
            print(f"{done:,} of {len(cases):,}", file=sys.stderr, flush=True)
        if time.monotonic() > stop:
            break
    print("\n".join(_table(outcomes)))
    sys.exit(bool(failures))


def _command(case: Case) -> str:
    kind, seed = case
    return f"PYTHONPATH=tests/python python benchmarks/fuzz.py --one {kind} --seed {seed}"


def _table(outcomes: Counter[tuple[str, str]]) -> Iterator[str]:
    yield "| cases | ended as | number |\n| --- | --- | --- |"
    for (kind, ending), count in sorted(outcomes.items()):
        yield f"| {kind} | {ending} | {count:,} |"


if __name__ == "__main__":
    main()
