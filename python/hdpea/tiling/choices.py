# SPDX-License-Identifier: GPL-3.0-or-later
"""Every value of a run in tiles that nobody gave: what was chosen for all of them, and what each chose by itself."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hdpea.embedding.device import device_choices
from hdpea.embedding.direct import length_choice
from hdpea.mesh.assembly import spreading_options
from hdpea.options.choice import Choice
from hdpea.options.embedding import BENDING_LENGTH, CURVATURE_RADIUS
from hdpea.tiling.work import Agreed, Work


def choices_of(work: Work) -> list[Choice]:
    """Return what was chosen, in the order of the stages, with the names that it has in one piece."""
    plan, tiles = work.plan, range(work.plan.tiles)
    prepared = [work.folder.facts("prepared", tile) for tile in tiles]
    embedded = [work.folder.facts("embedded", tile) for tile in tiles]
    points = [each["points"] for each in prepared]
    own = [list(map(_choice, each["choices"])) for each in prepared]
    of_embedding = [list(map(_choice, each["choices"])) for each in embedded]
    return [
        *device_choices(work.options.embedding.device),
        Choice("tiles", plan.tiles, "", f"of {plan.tile_points:,} points at most, halo included"),
        Choice("halo", plan.halo * plan.frame.diagonal, "world units", "beyond a tile, its points are known"),
        *merged(own, points),
        *map(_choice, work.folder.facts("agreed")["choices"]),
        *_lengths(work),
        *merged(of_embedding, points),
        *_steps(work),
        *map(_choice, work.folder.facts("mesh", 0)["choices"]),
    ]


def merged(choices: Sequence[Sequence[Choice]], points: Sequence[int]) -> list[Choice]:
    """Return as one what tiles have chosen each by itself.

    Where they chose alike it is that; of numbers that differ their range; of names that which counts for most points.

    Parameters
    ----------
    choices
        Of each tile.
    points
        How many points each has.
    """
    counted = [(choice, weight) for each, weight in zip(choices, points, strict=True) for choice in each]
    names = dict.fromkeys(choice.name for choice, _ in counted)
    return [_merged([each for each in counted if each[0].name == name]) for name in names]


def _merged(found: list[tuple[Choice, int]]) -> Choice:
    first, _ = max(found, key=lambda each: each[1])
    values = {choice.value for choice, _ in found}
    largest = f"in the largest tile {first.why}" if len({choice.why for choice, _ in found}) > 1 else first.why
    if len(values) == 1:
        return Choice(first.name, first.value, first.unit, largest)
    numbers = [value for value in values if not isinstance(value, str)]
    if len(numbers) == len(values):
        return Choice(first.name, f"{min(numbers):g} to {max(numbers):g}", first.unit, f"tiles differ; {largest}")
    of_value = {value: sum(w for choice, w in found if choice.value == value) for value in sorted(map(str, values))}
    most = max(of_value, key=lambda value: of_value[value])
    why = next(choice.why for choice, _ in sorted(found, key=lambda each: -each[1]) if choice.value == most)
    share = of_value[most] / max(sum(of_value.values()), 1)
    return Choice(first.name, most, first.unit, f"in tiles with {share:.0%} of the points, of which the largest: {why}")


def _lengths(work: Work) -> list[Choice]:
    """Return the lengths of the direct embedding that were not given: they are of all tiles together."""
    agreed, options = Agreed.of(work), work.options.embedding
    if options.embedding != "direct":
        return []
    spacing = agreed.spacing * work.plan.frame.diagonal
    asked = {
        "bending_length": (options.bending_length, BENDING_LENGTH),
        "curvature_radius": (options.curvature_radius, CURVATURE_RADIUS),
    }
    return [
        length_choice(name, spacings * spacing, spacings, agreed.resolution)
        for name, (given, spacings) in asked.items()
        if given is None
    ]


def _steps(work: Work) -> tuple[Choice, ...]:
    """Return the number of steps of the particles, if it was not given."""
    agreed = Agreed.of(work)
    return spreading_options(work.options.particles, evened=agreed.particles > agreed.vertices)[1]


def _choice(kept: dict[str, Any]) -> Choice:
    """Return a choice as a task has saved it."""
    return Choice(**kept)
