# SPDX-License-Identifier: GPL-3.0-or-later
"""Random clouds, damaged files and broken calls of the core: whatever comes, a true mesh or a documented error.

    make fuzz [CLOUDS=10000] [FILES=5000] [SEED=0]

Each case is known by its seed, and runs in a process of its own with limits of time and memory, so that a crash is one
failure of many. Failures are listed with the command that repeats one; any of them ends the script with exit code 1.
"""

from __future__ import annotations

import resource
import sys
from collections import Counter
from collections.abc import Iterator

import click
from helpers.fuzzing import clouds, core, files

from hdpea.runtime.processes import run_isolated

SECONDS, GIGABYTES = 120, 6
"""Limits of one case."""

KINDS = {"clouds": clouds.run, "files": files.run, "core": core.run}

Case = tuple[str, int]


def run_case(case: Case) -> str:
    """Run one case under the limits; return how it ended."""
    kind, seed = case
    resource.setrlimit(resource.RLIMIT_AS, (GIGABYTES << 30, GIGABYTES << 30))
    return KINDS[kind](seed)


@click.command()
@click.option("--clouds", "cloud_count", default=10_000, show_default=True, help="random clouds")
@click.option("--files", "file_count", default=5_000, show_default=True, help="damaged files")
@click.option("--core", "core_count", default=4_000, show_default=True, help="calls of the core")
@click.option("--seed", default=0, show_default=True, help="of the first case; the others count up from it")
@click.option("--jobs", default=2, show_default=True, help="processes")
@click.option("--one", type=click.Choice(list(KINDS)), help="run the one case of this kind and seed, here")
def main(*, cloud_count: int, file_count: int, core_count: int, seed: int, jobs: int, one: str | None) -> None:
    """Fuzz hdpea."""
    if one:
        print(run_case((one, seed)))
        return
    counts = {"clouds": cloud_count, "files": file_count, "core": core_count}
    cases = [(kind, seed + each) for kind, count in counts.items() for each in range(count)]
    outcomes, failures = Counter[tuple[str, str]](), list[tuple[Case, str]]()
    for done, outcome in enumerate(run_isolated(run_case, cases, jobs, SECONDS), start=1):
        kind, _ = cases[outcome.index]
        if outcome.failed:
            failures.append((cases[outcome.index], outcome.failed))
            print(f"{kind} {cases[outcome.index][1]}: {outcome.failed}", flush=True)
        outcomes[kind, "FAILED" if outcome.failed else str(outcome.result)] += 1
        if done % 1_000 == 0:
            print(f"{done:,} of {len(cases):,}", file=sys.stderr, flush=True)
    print("\n".join(_table(outcomes)))
    for (kind, number), why in failures[:20]:
        print(f"python benchmarks/fuzz.py --one {kind} --seed {number}   # {why}")
    sys.exit(bool(failures))


def _table(outcomes: Counter[tuple[str, str]]) -> Iterator[str]:
    yield "| cases | ended as | number |\n| --- | --- | --- |"
    for (kind, ending), count in sorted(outcomes.items()):
        yield f"| {kind} | {ending} | {count:,} |"


if __name__ == "__main__":
    main()
