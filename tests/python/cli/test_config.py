# SPDX-License-Identifier: GPL-3.0-or-later
"""The config file, and which of the two wins."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from hdpea.cli.config import config_option
from hdpea.cli.parameters import chosen_options, setting_options
from hdpea.errors import UsageError
from hdpea.options import Options
from hdpea.options.lengths import Length

Chosen = Callable[..., Options]


@pytest.fixture
def chosen(tmp_path: Path) -> Chosen:
    """Return a function from the text of a config file, and flags, to the options they make."""
    found: list[Options] = []

    @click.command()
    @config_option
    @setting_options("meshing", "normals", "refinement")
    @click.pass_context
    def command(ctx: click.Context, /, **values: object) -> None:
        found.append(chosen_options(ctx, values))

    def choose(config: str, *flags: str) -> Options:
        (tmp_path / "run.toml").write_text(config)
        result = CliRunner().invoke(command, ["--config", str(tmp_path / "run.toml"), *flags], catch_exceptions=False)
        if result.exit_code:
            raise UsageError(result.output)
        return found[-1]

    return choose


def test_settings_come_from_the_file(chosen: Chosen) -> None:
    options = chosen('vertices = 500\nfill-holes = "1%"\nrefine = false\nnormals = "estimate"\n')
    assert options.meshing.vertices == 500
    assert options.meshing.fill_holes == Length(1, percent=True)
    assert not options.refinement.refine
    assert options.normals.normals == "estimate"


def test_lengths_may_be_plain_numbers(chosen: Chosen) -> None:
    assert chosen("fill_holes = 0.5").meshing.fill_holes == Length(0.5)


def test_flags_win(chosen: Chosen) -> None:
    options = chosen("vertices = 500\nrefine = false", "--vertices", "600", "--refine")
    assert options.meshing.vertices == 600
    assert options.refinement.refine


def test_a_flag_rules_out_its_rival_in_the_file(chosen: Chosen) -> None:
    meshing = chosen("vertices = 500", "--faces", "600").meshing
    assert (meshing.vertices, meshing.faces) == (None, 600)


def test_rivals_in_the_file_are_refused(chosen: Chosen) -> None:
    with pytest.raises(UsageError, match="exclude"):
        chosen("vertices = 500\nfaces = 600")


def test_an_unknown_key_names_the_nearest(chosen: Chosen) -> None:
    with pytest.raises(UsageError, match="'vertises'") as caught:
        chosen("vertises = 500")
    assert "'vertices'" in caught.value.hint


@pytest.mark.parametrize(
    ("config", "reason"),
    [
        ("vertices = 'many'", "not a whole number"),
        ("vertices = 10.5", "not a whole number such as 5000"),
        ("vertices = 3", "at least 4"),
        ("refine = 'perhaps'", "perhaps"),
        ("vertices", "not a TOML file"),
        (f"vertices = {'[' * 5000}{']' * 5000}", "nested too deep"),
        (f"vertices = 0x{'f' * 6000}", "not a setting's"),
        (f"vertices = {2**64}", "is at most"),
        ("[meshing]\nvertices = 500", "table"),
    ],
)
def test_wrong_values_and_files_are_refused(config: str, reason: str, chosen: Chosen) -> None:
    with pytest.raises(UsageError, match=reason):
        chosen(config)


def test_a_missing_file_is_refused(chosen: Chosen, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="No such file"):
        chosen("", "--config", str(tmp_path / "none.toml"))
