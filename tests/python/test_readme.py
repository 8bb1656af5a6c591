# SPDX-License-Identifier: GPL-3.0-or-later
"""The README says what the code does: its options, its exit codes, its example, its links."""

from __future__ import annotations

import re
from pathlib import Path

import click
import pytest

from hdpea.cli.reconstruct import command
from hdpea.errors import HdpeaError

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()


def default_of(option: click.Option) -> str:
    """What the help shows in brackets, if anything."""
    if option.default is None or not option.show_default:
        return ""
    if option.secondary_opts:
        return f"`{(option.opts if option.default else option.secondary_opts)[0]}`"
    return f"`{option.default}`"


def options_table() -> str:
    """Every flag of `hdpea reconstruct` with its default and its help."""
    lines = ["| option | default | |", "|---|---|---|"]
    for option in command.params:
        if isinstance(option, click.Option):
            flags = " / ".join(f"`{flag}`" for flag in [*option.opts, *option.secondary_opts])
            explained = str(option.help).replace("|", "\\|")
            lines.append(f"| {flags} | {default_of(option)} | {explained} |")
    return "\n".join(lines)


def test_the_options_are_those_of_the_command() -> None:
    written = README.split("<!-- options -->\n")[1].split("\n<!-- /options -->")[0]
    assert written == options_table(), f"paste this between the marks of README.md:\n{options_table()}"


HEADLINE = (
    "method", "vertices", "exact CD (1e-5)", "exact HD (1e-2)", "G", "F1", "NC", "manifold", "watertight", "CPU seconds"
)  # fmt: skip


def headline_table() -> str:
    """Return some columns of the results of the suite `sampling`."""
    results = (ROOT / "docs/results/sampling/results.md").read_text().split("## Published")[0]
    rows = [line.strip("| ").split(" | ") for line in results.splitlines() if line.startswith("|")]
    shown = [rows[0].index(title) for title in HEADLINE]
    return "\n".join("| " + " | ".join((row + [""] * len(rows[0]))[i] for i in shown) + " |" for row in rows)


def test_the_headline_is_that_of_the_suite() -> None:
    written = README.split("<!-- results -->\n")[1].split("\n<!-- /results -->")[0]
    assert written == headline_table(), f"paste this between the marks of README.md:\n{headline_table()}"


def kinds_of_error(kind: type[HdpeaError] = HdpeaError) -> set[type[HdpeaError]]:
    return {kind}.union(*(kinds_of_error(each) for each in kind.__subclasses__()))


def test_the_exit_codes_are_those_of_the_errors() -> None:
    written = {int(code) for code in re.findall(r"^\| (\d+) \|", README.split("## Exit codes")[1], re.MULTILINE)}
    assert written == {0} | {kind.exit_code for kind in kinds_of_error()}


@pytest.mark.slow
def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    example, *_ = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    exec(compile(example, "README.md", "exec"), {})  # noqa: S102 it is our own
    assert "(1000, 3)" in capsys.readouterr().out


@pytest.mark.parametrize(
    "page", ["README.md", "CONTRIBUTING.md", *(f"docs/{each.name}" for each in ROOT.glob("docs/*.md"))]
)
def test_links_lead_somewhere(page: str) -> None:
    file = ROOT / page
    links = re.findall(r"\]\(([^)#:]+)\)", file.read_text())
    assert [link for link in links if not (file.parent / link).exists()] == []
