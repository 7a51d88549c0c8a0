"""What tests of the viewer share: which pages there are, and what is shown on them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
from playwright.sync_api import Page, expect

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

FAILING = "lambert-sphere+closed_form+local"
STOCHASTIC = "lambert-sphere+mitsuba+path"
DECLARED = "whitted-1980+povray+trace"

VIEWER = "document.querySelector('.viewer').viewer"


def cell_page(report: Path, name: str = FAILING) -> Path:
    """The file of a cell's page."""
    return report.parent / "report" / "cells" / f"{name}.html"


def ready(page: Page) -> Page:
    """The page, once its viewer is there and has drawn."""
    until(page, f"{VIEWER} !== undefined")
    drawn(page)
    return page


def until(page: Page, condition: str) -> None:
    """Wait until it holds; pages forbid what Playwright's own waiting does."""
    page.evaluate(
        f"""async () => {{
          const end = performance.now() + 20_000;
          while (!({condition})) {{
            if (performance.now() > end) throw new Error("it never came to hold");
            await new Promise((done) => setTimeout(done, 20));
          }}
        }}"""
    )


def drawn(page: Page) -> None:
    """Wait until what was asked for is on the screen."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def press(page: Page, *keys: str) -> None:
    """Press keys one after the other, each drawn before the next."""
    for key in keys:
        page.keyboard.press(key)
        drawn(page)


def state(page: Page) -> dict[str, Any]:
    """What the viewer shows."""
    names = "current, previous, held, mode, divider, view, pixel, isPinned, isMasked, tolerance, settings"
    found: dict[str, Any] = page.evaluate(f"() => {{ const {{ {names} }} = {VIEWER}; return {{ {names} }}; }}")
    return found


def choose(page: Page, x: int, y: int) -> None:
    """Choose a pixel by its coordinates."""
    for label, value in (("x", x), ("y", y)):
        field = page.get_by_label(label, exact=True)
        field.fill(str(value))
        field.press("Enter")
    drawn(page)


def expect_pixel(page: Page, x: int, y: int) -> None:
    """Wait until the pixel's numbers are shown."""
    expect(page.locator(".outcome")).to_have_text(re.compile(rf"^Pixel \({x}, {y}\): "))


def rows(page: Page) -> dict[str, list[list[str]]]:
    """The pixel's table: under each row's header the lines of its three cells."""
    table = page.locator(".pixel tbody tr").evaluate_all(
        """all => all.map(r => [r.querySelector("th").textContent.split(/\\s+/).join(" ").trim(),
            [...r.querySelectorAll("td")].map(d => [...d.querySelectorAll(".line")].map(l => l.textContent))])"""
    )
    return dict(table)


def float32(texts: list[list[str]], line: int = 0) -> NDArray[np.float32]:
    """The numbers in one line of a row."""
    words = {"not a number": "nan", "infinite": "inf"}
    return np.array([float(words.get(cell[line], cell[line])) for cell in texts]).astype(np.float32)


def colour_of(page: Page, x: int, y: int, pane: int = 0) -> list[int]:
    """The colour at a quarter of a pixel of the image from its corner, where no number is drawn."""
    found: list[int] = page.evaluate(
        f"""([x, y, pane]) => {{
          const viewer = {VIEWER};
          const canvas = viewer.panes[pane].canvas;
          const at = (place, from) => Math.round((place + 0.25 - from) * viewer.view.scale * devicePixelRatio);
          const data = canvas.getContext("2d").getImageData(at(x, viewer.view.x), at(y, viewer.view.y), 1, 1).data;
          return [...data.slice(0, 3)];
        }}""",
        [x, y, pane],
    )
    return found


def screen_place(page: Page, x: int, y: int) -> tuple[float, float]:
    """Where on the screen the middle of a pixel is."""
    page.locator(".stage").scroll_into_view_if_needed()
    place = page.evaluate(
        f"""([x, y]) => {{
          const viewer = {VIEWER};
          const box = viewer.panes[0].host.getBoundingClientRect();
          const at = (place, from) => (place + 0.5 - from) * viewer.view.scale;
          return [box.left + at(x, viewer.view.x), box.top + at(y, viewer.view.y)];
        }}""",
        [x, y],
    )
    return place[0], place[1]
