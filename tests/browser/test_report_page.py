import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO
import pytest
from playwright.sync_api import expect

from raytruth.reports.wording import WORDINGS
from tests.browser.contrasts import CONTRASTS, WCAG_AA
from tests.reports.sample_results import ODD_NAME, SIDE, sample_document

pytestmark = pytest.mark.clause("REP-4")

DECODED = """async () => {
  const decoded = [];
  for (const stored of document.querySelectorAll("svg.store image")) {
    const image = new Image();
    image.src = stored.getAttribute("href");
    await image.decode();
    decoded.push([image.naturalWidth, image.naturalHeight]);
  }
  return decoded;
}"""


VERDICTS_BY_VISIBILITY = """(all) => {
  const shown = {};
  for (const element of all) {
    const { verdict } = element.dataset;
    if (verdict in shown && shown[verdict] !== element.checkVisibility()) throw new Error(`some ${verdict} only`);
    shown[verdict] = element.checkVisibility();
  }
  return shown;
}"""


@pytest.mark.clause("REP-1")
def test_the_page_asks_for_nothing_and_complains_of_nothing(visit: Any, report: Path) -> None:
    opened = visit()
    for summary in opened.page.locator("summary").all():
        summary.click()
    assert [url for url in opened.requests if not url.startswith("data:")] == [report.as_uri()]
    assert opened.complaints == []


def test_every_image_is_decoded_at_its_size(visit: Any) -> None:
    page = visit().page
    sizes = page.locator("img").evaluate_all("all => all.map(i => [i.complete, i.naturalWidth, i.naturalHeight])")
    assert len(sizes) > 10
    assert all(size == [True, SIDE, SIDE] for size in sizes)
    assert page.evaluate(DECODED) == [[SIDE, SIDE]]


def test_the_shared_truth_is_drawn_wherever_it_is_shown(visit: Any, tmp_path: Path) -> None:
    shown = visit().page.locator("svg.picture")
    assert shown.count() > 6
    for picture in (shown.first, shown.last):
        path = tmp_path / "shown.png"
        picture.screenshot(path=path)
        pixels = np.asarray(OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.UINT8))[..., :3]
        assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 50  # a shaded sphere, not an empty box


def test_small_images_are_enlarged_as_squares(visit: Any) -> None:
    image = visit().page.locator("article img").first
    assert image.evaluate("i => getComputedStyle(i).imageRendering") == "pixelated"
    assert image.evaluate("i => i.getBoundingClientRect().width") > 3 * SIDE


@pytest.mark.parametrize("javascript", [True, False])
def test_every_cell_of_the_matrix_leads_to_its_detail(visit: Any, report: Path, javascript: bool) -> None:
    page = visit(java_script_enabled=javascript).page
    links = page.locator("table.matrix td a")
    cells = sample_document(report.parent)["cells"]
    assert links.count() == len(cells)
    for link in links.all():
        link.click()
        target = page.locator("article:target")
        expect(target).to_be_in_viewport()
        assert f"#{target.get_attribute('id')}" == link.get_attribute("href")
    assert ODD_NAME in page.locator("article:target h4").inner_text()


def test_a_filter_hides_its_verdict_in_the_matrix_and_in_the_details(visit: Any) -> None:
    page = visit().page
    for verdict in WORDINGS:
        page.locator(f".chip.{verdict} input").uncheck()
        shown = page.locator("[data-verdict]").evaluate_all(VERDICTS_BY_VISIBILITY)
        assert shown == {v: v != verdict for v in WORDINGS}
        expect(page.get_by_role("status")).to_have_text(re.compile(r"Showing \d+ of 11 cells"))
        page.locator(f".chip.{verdict} input").check()
    assert page.locator("[data-verdict]").evaluate_all(VERDICTS_BY_VISIBILITY) == dict.fromkeys(WORDINGS, True)
    expect(page.get_by_role("status")).to_have_text("")


def test_a_scene_without_shown_cells_is_hidden(visit: Any) -> None:
    page = visit().page
    sections = page.locator("section.scene:visible")
    assert sections.count() == 3
    page.locator(".chip.pass input").uncheck()
    assert sections.count() == 2


def test_without_javascript_all_is_shown_and_no_dead_control(visit: Any) -> None:
    page = visit(java_script_enabled=False).page
    assert page.locator("article:visible").count() == 11
    assert page.locator("input:visible, button:visible").count() == 0
    page.locator("summary").last.click()
    assert "last line" in page.locator("pre.log").inner_text()


@pytest.mark.parametrize("width", [400, 1600])
def test_the_page_never_scrolls_sideways(visit: Any, width: int) -> None:
    page = visit(width).page
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    over = "all => all.filter(e => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('.scroll')).length"
    assert page.locator("body *:visible").evaluate_all(over) == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_text_is_legible_in_both_schemes(visit: Any, scheme: str) -> None:
    page = visit(color_scheme=scheme).page
    found = page.evaluate(CONTRASTS)
    assert len(found) > 100
    assert [text for text in found if text["contrast"] < WCAG_AA] == []
    dark = page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(20, 24, 27)"
    assert dark == (scheme == "dark")


def test_the_copy_button_copies_the_command_of_its_cell(visit: Any, report: Path) -> None:
    page = visit().page
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    button = page.locator("article.fail").get_by_role("button")
    button.click()
    expect(button).to_have_text("Copied")
    command = next(c["command"] for c in sample_document(report.parent)["cells"] if c["verdict"] == "fail")
    assert page.evaluate("navigator.clipboard.readText()") == command


def test_a_refused_clipboard_leaves_the_command_selected(visit: Any) -> None:
    page = visit().page
    page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error('refused')); }")
    failing = page.locator("article.fail")
    button = failing.get_by_role("button")
    button.click()
    expect(button).to_have_text("Selected: press Ctrl+C")
    assert page.evaluate("String(getSelection())").strip() == failing.locator("code:visible").inner_text()


def test_headings_descend_by_one_and_every_picture_has_its_words(visit: Any) -> None:
    page = visit().page
    levels = page.locator("h1, h2, h3, h4, h5").evaluate_all("all => all.map(h => Number(h.tagName[1]))")
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(deeper <= level + 1 for level, deeper in pairwise(levels))
    assert page.locator("article img:not([alt]), article img[alt='']").count() == 0
    assert page.locator("article svg.picture[aria-label='']").count() == 0


def test_the_keyboard_reaches_the_matrix_and_follows_its_links(visit: Any) -> None:
    page = visit().page
    page.keyboard.press("Tab")
    expect(page.locator(".skip")).to_be_focused()
    page.keyboard.press("Enter")
    link = page.locator("table.matrix td a").first
    for _ in range(20):
        page.keyboard.press("Tab")
        if link.evaluate("e => e === document.activeElement"):
            break
    expect(link).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator("article:target")).to_be_in_viewport()
