"""Rules that a program can check, by axe; what it cannot check is in the other files of this folder."""

from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe

from tests.browser.viewing import cell_page, press, ready

pytestmark = pytest.mark.clause("REP-4")

SERIOUS = {"serious", "critical"}


def serious_violations(page: Any) -> list[str]:
    """What axe finds, in a line each; the page's policy forbids scripts of others, so that a test switches it off."""
    found = Axe().run(page).response
    assert len(found["passes"]) > 10  # it looked
    return [f"{v['id']}: {v['nodes'][0]['html'][:200]}" for v in found["violations"] if v["impact"] in SERIOUS]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1600])
@pytest.mark.parametrize("which", ["overview", "cell", "pixel", "palette", "scene"])
def test_axe_finds_no_serious_violation(visit: Any, report: Path, which: str, width: int, scheme: str) -> None:
    scene = report.parent / "report" / "scenes" / "lambert-sphere.html"
    path = {"overview": report, "scene": scene}.get(which, cell_page(report))
    page = visit(path=path, width=width, color_scheme=scheme, locale="en-GB", bypass_csp=True).page
    if path == cell_page(report):
        ready(page)
    if which == "pixel":
        page.locator(".stage").focus()
        press(page, "n", "z", "v", "v")
    if which == "palette":
        page.keyboard.press("Control+k")
    assert serious_violations(page) == []


def test_axe_sees_a_button_without_a_name(visit: Any) -> None:
    page = visit(locale="en-GB", bypass_csp=True).page
    page.evaluate("() => document.querySelector('main').append(document.createElement('button'))")
    assert [line.split(":")[0] for line in serious_violations(page)] == ["button-name"]
