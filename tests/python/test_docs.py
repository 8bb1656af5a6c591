# SPDX-License-Identifier: GPL-3.0-or-later
"""The README and docs say what the code does: options, exit codes, examples, commands, links."""

from __future__ import annotations

import re
from pathlib import Path

import click
import command_pages
import pytest
import shown_commands

from hdpea.errors import HdpeaError
from hdpea.mesh.noise import DEVIATIONS

ROOT = Path(__file__).parents[2]
COMMAND_PAGES = sorted((ROOT / "docs/commands").glob("*.md"))


@pytest.mark.parametrize("page", COMMAND_PAGES, ids=lambda page: page.stem)
def test_pages_of_commands_say_what_the_help_says(page: Path) -> None:
    written = page.read_text()
    assert written == command_pages.renewed(written), "python tools/command_pages.py docs/commands/*.md writes it anew"


def test_every_command_has_a_page() -> None:
    described = [found[1] for page in COMMAND_PAGES for found in command_pages.PART.finditer(page.read_text())]
    assert sorted(described) == sorted(command_pages.all_names())


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
    page = (ROOT / "docs/comparison.md").read_text()
    written = page.split("<!-- results -->\n")[1].split("\n<!-- /results -->")[0]
    assert written == headline_table(), f"paste this between the marks of docs/comparison.md:\n{headline_table()}"


def test_the_notice_says_of_the_weights_what_the_docs_say() -> None:
    notice = (ROOT / "NOTICE").read_text().split("The weights ")[1]
    included = (ROOT / "docs/training.md").read_text().split("## The included weights")[1]
    assert re.findall(r"([\d,]+) meshes", notice) == re.findall(r"\*\*Data\.\*\* ([\d,]+) closed meshes", included)
    licences = " ".join(re.findall(r"\*\*Licences of the meshes\.\*\* (.*?)\.", included, re.DOTALL)[0].split())
    assert all(part in " ".join(notice.split()) for part in re.split(r"[,;] ", licences))


def test_the_journeys_tell_the_times_of_the_tables() -> None:
    pages = {name: (ROOT / f"docs/{name}.md").read_text() for name in ("journeys", "performance", "scaling")}
    (row,) = re.findall(r"^\| 250,000, normals \|.*", pages["performance"], re.MULTILINE)
    seconds, memory = (row.split(" | ")[column] for column in (2, 5))
    assert f"250,000 points with normals took {float(seconds):.0f} s and {memory} GB" in pages["journeys"]
    ((clock, processor),) = re.findall(r"([\d,]+) s by the clock and ([\d,]+) s of a processor", pages["scaling"])
    assert f"took {processor} s of a processor, {clock} s by the clock" in pages["journeys"]
    assert f"{4 * int(clock) / 60:.0f} minutes on two cores" in pages["journeys"]


@pytest.mark.parametrize("page", ["docs/journeys.md", "docs/commands/reconstruct.md"])
def test_the_least_error_that_noise_allows_is_that_of_the_code(page: str) -> None:
    told = re.findall(r"of\s+less\s+than\s+(\S+)\s+times\s+the\s+noise", (ROOT / page).read_text())
    assert told == [str(DEVIATIONS)]


def anchors(page: Path) -> set[str]:
    """Return what GitHub calls the headings of a page."""
    headings = re.findall(r"^#+ (.*)", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", ["README.md", *shown_commands.PAGES[1:]])
def test_links_lead_to_headings(page: str) -> None:
    file = ROOT / page
    links = re.findall(r"\]\(([^)#:]*\.md)?#([^)]+)\)", file.read_text())
    assert [link for link in links if link[1] not in anchors(file.parent / link[0] if link[0] else file)] == []


def kinds_of_error(kind: type[HdpeaError] = HdpeaError) -> set[type[HdpeaError]]:
    return {kind}.union(*(kinds_of_error(each) for each in kind.__subclasses__()))


def test_the_exit_codes_are_those_of_the_errors() -> None:
    page = (ROOT / "docs/exit_codes.md").read_text()
    written = {int(code) for code in re.findall(r"^\| (\d+) \|", page, re.MULTILINE)}
    assert written == {0} | {kind.exit_code for kind in kinds_of_error()}


@pytest.mark.slow
def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    example, *_ = re.findall(r"```python\n(.*?)```", (ROOT / "docs/start.md").read_text(), re.DOTALL)
    exec(compile(example, "start.md", "exec"), {})  # noqa: S102 it is our own
    assert "(1000, 3)" in capsys.readouterr().out


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", *shown_commands.PAGES[1:]])
def test_links_lead_somewhere(page: str) -> None:
    file = ROOT / page
    links = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", file.read_text())
    assert [link for link in links if not (file.parent / link).exists()] == []


def test_every_page_is_in_the_menu_of_the_site() -> None:
    menu = set(re.findall(r": (\S+\.md)$", (ROOT / "mkdocs.yml").read_text(), re.MULTILINE))
    assert menu >= {str(page.relative_to(ROOT / "docs")) for page in (ROOT / "docs").rglob("*.md")}


@pytest.mark.parametrize("page", [page for page in shown_commands.PAGES if shown_commands.shown(page)])
def test_commands_on_the_pages_are_understood(page: str) -> None:
    for line in shown_commands.shown(page):
        shown_commands.check(line)


def test_a_command_that_is_not_understood_is_found() -> None:
    with pytest.raises(click.UsageError):
        shown_commands.check("hdpea reconstruct scan.ply mesh.obj --edges 500 > log.txt")


@pytest.mark.slow
@pytest.mark.parametrize("page", ["README.md"])
def test_commands_on_the_front_page_run(page: str) -> None:
    assert shown_commands.run_page(page, shown_commands.FEW) == []
