# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of hdpea in a browser, driven as a hand would."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, Page

DESK, PHONE = {"width": 1100, "height": 700}, {"width": 390, "height": 760}


@contextmanager
def opened(browser: Browser, page: Path, screen: dict[str, int], fragment: str = "") -> Iterator[Page]:
    """Open a page, which may say nothing on its console."""
    said: list[str] = []
    tab = browser.new_page(viewport=screen, has_touch=screen is PHONE)
    tab.on("console", lambda message: said.append(message.text))
    tab.on("pageerror", lambda error: said.append(str(error)))
    tab.on(
        "request", lambda request: said.append(request.url) if not request.url.startswith(("file:", "data:")) else None
    )
    tab.goto(f"{page.resolve().as_uri()}#{fragment}")
    tab.wait_for_selector("body[data-triangles]")
    yield tab
    tab.close()
    if said:
        raise click.ClickException(f"{page.name}: {said}")


def _elsewhere(url: str) -> bool:
    return not url.startswith(("file:", "data:", "blob:"))


def pixels(tab: Page) -> NDArray[np.uint8]:
    """Return what is seen, once it is drawn."""
    tab.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return np.asarray(Image.open(io.BytesIO(tab.screenshot())).convert("RGB"))


@dataclass(frozen=True)
class Driven:
    """What a page was made to show.

    Attributes
    ----------
    shapes
        That it holds.
    triangles, points
        That are drawn at first.
    colorings
        That it offers.
    """

    shapes: int
    triangles: int
    points: int
    colorings: tuple[str, ...]


def drive(tab: Page) -> Driven:
    """Use all of the panel; every step must change what is seen."""
    drawn = tab.evaluate("({...document.body.dataset})")
    seen = pixels(tab)

    def changed(step: str) -> None:
        nonlocal seen
        before, seen = seen, pixels(tab)
        if (before == seen).all():
            raise click.ClickException(f"{tab.title()}: {step} changes nothing.")

    size = tab.viewport_size or DESK
    middle = 0.65 * size["width"], 0.7 * size["height"]
    tab.mouse.move(*middle)
    tab.mouse.down()
    tab.mouse.move(middle[0] + 90, middle[1] + 30, steps=5)
    tab.mouse.up()
    changed("turning")
    tab.mouse.wheel(0, -200)
    changed("zooming")
    if not tab.locator("details").evaluate("(each) => each.open"):
        tab.locator("summary").click()
        changed("the panel")
    colorings = _values(tab, "coloring")
    for name in sorted(set(colorings) - {tab.locator("#coloring").input_value()}):
        tab.select_option("#coloring", name)
        changed(f"colour by {name or 'nothing'}")
    for name in ("edges", "points"):
        if tab.locator(f"#{name}").is_visible():
            tab.locator(f"#{name}").click()
            changed(name)
    shapes = _values(tab, "first")
    for which in ("first", "second") if len(shapes) > 1 else ():
        others = [each for each in shapes if each != tab.locator(f"#{which}").input_value()]
        tab.select_option(f"#{which}", others[-1])
        changed(which)
    tab.mouse.dblclick(*middle)
    changed("going back")
    return Driven(len(shapes), int(drawn["triangles"]), int(drawn["points"]), tuple(filter(None, colorings)))


def _values(tab: Page, select: str) -> list[str]:
    values: list[str] = tab.locator(f"#{select} option").evaluate_all("(all) => all.map((each) => each.value)")
    return values
