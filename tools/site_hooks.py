# SPDX-License-Identifier: GPL-3.0-or-later
"""What the site has besides the files of docs/: the README as its front page, and the sources that pages link to.

Pages link to files of the repository, as they would be read there. Those outside docs/ become pages of their own here,
so that every link leads somewhere without a network. Formulas become MathML, which browsers draw unaided. The pages of
`make gallery` come along if they were made.
"""

from __future__ import annotations

import ast
import html
import posixpath
import re
from collections.abc import Iterator
from pathlib import Path

from latex2mathml.converter import convert
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[1]
PAGES = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
"""Pages that lie outside docs/, and what they are called on the site."""

LINK = re.compile(r"\]\((?!\w+:|#)([^)\s#]+)(#[^)\s]*)?\)")
FORMULA = re.compile(r"^```math\n(.*?)^```$", re.DOTALL | re.MULTILINE)
SOURCE = re.compile(r"^<!-- source (\S+) -->$", re.MULTILINE)
GALLERY = ROOT / "build/gallery"
"""Where `make gallery` leaves pages, and a small picture of each."""

GALLERY_SHEET = re.compile(r"^!\[.*\]\(gallery\.jpg\)$", re.MULTILINE)
LANGUAGES = {".py": "python", ".cpp": "cpp", ".hpp": "cpp", ".sh": "sh", ".txt": "text"}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that lie outside docs/, and the sources that any page links to."""
    for path, name in PAGES.items():
        files.append(File.generated(config, name, content=(ROOT / path).read_text()))
    for path in (*_gallery_pages(), *(page.with_suffix(".jpg") for page in _gallery_pages())):
        files.append(File.generated(config, f"gallery/{path.name}", abs_src_path=str(path)))
    pages = [*PAGES, *(f"docs/{each.src_uri}" for each in files.documentation_pages() if each.src_uri not in _named())]
    linked = {target for page in pages for target in _targets(page) if _uri(target).startswith("source/")}
    for target in sorted(linked):
        files.append(File.generated(config, _uri(target), content=_source_page(target, linked)))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001
    """Let links lead to pages of the site, draw formulas, and show the sources and the gallery that a page asks for."""
    uri = page.file.src_uri
    if uri.startswith("source/"):
        return markdown
    if uri == "gallery.md" and _gallery_pages():
        markdown = GALLERY_SHEET.sub(_gallery_links(), markdown)

    def renamed(found: re.Match[str]) -> str:
        target = _resolved(_origin(uri), found[1])
        return f"]({posixpath.relpath(_uri(target), posixpath.dirname(uri) or '.')}{found[2] or ''})"

    markdown = LINK.sub(renamed, markdown)
    markdown = SOURCE.sub(lambda found: _fenced(found[1]), markdown)
    return FORMULA.sub(lambda found: f"<div>{convert(found[1].strip(), display='block')}</div>", markdown)


def _gallery_pages() -> list[Path]:
    return sorted(GALLERY.glob("*.html"))


def _gallery_links() -> str:
    """Return the pictures of the gallery, each a link to the page that turns, in place of the sheet of all."""
    names = [page.stem for page in _gallery_pages()]
    look = "width=24%"
    return "\n".join(f"[![{name}](gallery/{name}.jpg){{{look} title={name}}}](gallery/{name}.html)" for name in names)


def _named() -> frozenset[str]:
    return frozenset(PAGES.values())


def _origin(uri: str) -> str:
    """Return where a page lies in the repository."""
    return next((path for path, name in PAGES.items() if name == uri), f"docs/{uri}")


def _resolved(page: str, link: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), link))


def _targets(page: str) -> Iterator[str]:
    """Yield the files of the repository that a page links to."""
    for link, _ in LINK.findall((ROOT / page).read_text()):
        yield _resolved(page, link)


def _uri(target: str) -> str:
    """Return where a file or folder of the repository is on the site."""
    if target in PAGES:
        return PAGES[target]
    if target.startswith("docs/"):
        return target.removeprefix("docs/")
    return f"source/{target}/index.md" if (ROOT / target).is_dir() else f"source/{target}.md"


def _source_page(target: str, linked: set[str]) -> str:
    """Return a page with a file, or the list of a folder; the search leaves it out."""
    head = f"---\nsearch:\n  exclude: true\n---\n\n# {target}\n\n"
    if not (ROOT / target).is_dir():
        return head + _fenced(target)
    rows = []
    for file in sorted((ROOT / target).iterdir()):
        if file.is_file() and file.suffix in LANGUAGES:
            path = f"{target}/{file.name}"
            name = f"[{file.name}]({file.name}.md)" if path in linked else file.name
            rows.append(f"| {name} | {html.escape(_purpose(file)).replace('|', chr(92) + '|')} |")
    return head + "\n".join(["| file | |", "|---|---|", *rows])


def _fenced(target: str) -> str:
    file = ROOT / target
    return f"`````{LANGUAGES.get(file.suffix, 'text')}\n{file.read_text().rstrip()}\n`````"


def _purpose(file: Path) -> str:
    """Return the first line of a Python module's docstring, or of what a C++ header documents first."""
    text = file.read_text()
    if file.suffix == ".py":
        return (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
    found = re.search(r"^/// (.+)$", text, re.MULTILINE)
    return found[1] if found else ""
