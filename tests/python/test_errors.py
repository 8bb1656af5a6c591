# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import pytest

from hdpea import _core, errors


@pytest.mark.parametrize(
    ("kind", "exit_code"),
    [
        (errors.HdpeaError, 1),
        (errors.UsageError, 2),
        (errors.UnreadableInput, 3),
        (errors.CannotReconstruct, 4),
        (errors.QualityMissed, 5),
        (errors.Interrupted, 130),
        (errors.Terminated, 143),
    ],
)
def test_each_kind_has_its_exit_code(kind: type[errors.HdpeaError], exit_code: int) -> None:
    assert kind.exit_code == exit_code


@pytest.mark.parametrize(
    ("raised", "translated"),
    [
        (_core.InvalidArgument("k is 0"), errors.UsageError),
        (_core.CannotReconstruct("a line"), errors.CannotReconstruct),
        (_core.Cancelled("cancelled"), errors.Interrupted),
        (MemoryError(), errors.HdpeaError),
    ],
)
def test_errors_of_the_core_are_translated(raised: Exception, translated: type[errors.HdpeaError]) -> None:
    with pytest.raises(translated) as caught, errors.core_errors_translated():
        raise raised
    assert caught.value.message.endswith(".")
    assert caught.value.hint or translated is errors.Interrupted
    assert caught.value.__cause__ is raised


@pytest.mark.parametrize("other", [ValueError("ours"), RuntimeError("torch's"), KeyError("a bug")])
def test_other_errors_pass_unchanged(other: Exception) -> None:
    with pytest.raises(type(other)) as caught, errors.core_errors_translated():
        raise other
    assert caught.value is other
