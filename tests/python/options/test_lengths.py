# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hdpea.options.lengths import Length


def test_plain_number_is_in_world_units() -> None:
    assert Length.parse("0.02").resolve(diagonal=50.0) == 0.02


def test_percentage_is_of_the_diagonal() -> None:
    assert Length.parse(" 1 % ").resolve(diagonal=50.0) == 0.5


@given(st.floats(0, 1e300), st.booleans())
def test_what_is_printed_reads_back_the_same(value: float, percent: bool) -> None:
    length = Length(value, percent)
    assert Length.parse(str(length)) == length


@pytest.mark.parametrize("text", ["", "%", "wide", "1 mm", "-1", "-1%", "nan", "inf"])
def test_nonsense_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="length"):
        Length.parse(text)
