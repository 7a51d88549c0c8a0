import json
import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from raytruth.comparisons.records.kill_results import KILLS_FILE
from raytruth.reports.html import write_html_report
from raytruth.reports.wording import WORDINGS
from tests.browser.contrasts import CONTRASTS, WCAG_AA
from tests.browser.viewing import FAILING, STOCHASTIC, cell_page, ready
from tests.reports.sample_results import ODD_NAME, SIDE, sample_document, write_sample
from tests.reports.test_kills import RESULTS

pytestmark = pytest.mark.clause("REP-4")

ENGLISH = {"locale": "en-GB"}


@pytest.mark.clause("REP-1", "REP-10")
def test_the_page_asks_for_its_own_files_only_and_complains_of_nothing(visit: Any, report: Path) -> None:
    opened = visit(**ENGLISH)
    for summary in opened.page.locator("summary").all():
        summary.click()
    folder = report.parent.as_uri()
    assert all(url.startswith(folder) for url in opened.requests)
    assert not [url for url in opened.requests if "/arrays/" in url]
    assert opened.complaints == []


@pytest.mark.parametrize("name", [FAILING, STOCHASTIC])
def test_every_image_is_decoded_at_its_size(visit: Any, report: Path, name: str) -> None:
    page = visit(path=cell_page(report, name), java_script_enabled=False).page
    sizes = page.locator("img").evaluate_all("all => all.map(i => [i.complete, i.naturalWidth, i.naturalHeight])")
    assert len(sizes) == (5 if name == STOCHASTIC else 4)
    assert all(size == [True, SIDE, SIDE] for size in sizes)


def test_small_images_are_enlarged_as_squares(visit: Any, report: Path) -> None:
    image = visit(path=cell_page(report), java_script_enabled=False).page.locator("article img").first
    assert image.evaluate("i => getComputedStyle(i).imageRendering") == "pixelated"
    assert image.evaluate("i => i.getBoundingClientRect().width") > 3 * SIDE


@pytest.mark.parametrize("javascript", [True, False])
def test_every_cell_of_the_matrix_leads_to_its_page_and_back(visit: Any, report: Path, javascript: bool) -> None:
    page = visit(java_script_enabled=javascript, **ENGLISH).page
    cells = sample_document(report.parent)["cells"]
    links = page.locator("table.matrix td a")
    assert links.count() == len(cells)
    told = []
    for place in range(len(cells)):
        links.nth(place).click()
        told.append((page.locator("h1").inner_text(), page.locator(".cell-title").inner_text()))
        page.get_by_role("link", name="All cells").click()
    assert {scene for scene, _ in told} == {cell["scene"] for cell in cells}
    assert ODD_NAME in {scene for scene, _ in told}
    assert len(set(told)) == len(cells)


def shown(page: Page) -> list[str]:
    """The verdicts of the cells that are shown in the matrix."""
    found: list[str] = page.locator(".matrix [data-verdict]:visible").evaluate_all(
        "all => all.map(e => e.dataset.verdict)"
    )
    return found


def test_a_filter_hides_its_verdict(visit: Any) -> None:
    page = visit(**ENGLISH).page
    everything = shown(page)
    for verdict in WORDINGS:
        page.locator(f".chip.{verdict} input").uncheck()
        assert shown(page) == [other for other in everything if other != verdict]
        expect(page.locator("#filter-result")).to_have_text(re.compile(r"Showing \d+ of 11 cells"))
        page.locator(f".chip.{verdict} input").check()
    assert shown(page) == everything
    expect(page.locator("#filter-result")).to_have_text("")


@pytest.mark.parametrize(
    ("label", "value", "count"),
    [("Text", "lambert", 5), ("Text", "SIGNAL 6", 1), ("Text", "no such words", 0), ("Renderer", "mitsuba", 5)],
)
def test_text_and_renderer_choose_cells(visit: Any, label: str, value: str, count: int) -> None:
    page = visit(**ENGLISH).page
    control = page.locator(f"#filter-{label.lower()}")
    control.fill(value) if label == "Text" else control.select_option(value)
    assert len(shown(page)) == count


def test_a_feature_chooses_scenes(visit: Any, tmp_path: Path) -> None:
    directory = write_sample(tmp_path / "results")
    document = json.loads((directory / "results.json").read_text(encoding="utf-8"))
    document["scenes"][0]["features"] = ["torus"]
    (directory / "results.json").write_text(json.dumps(document), encoding="utf-8")
    page = visit(path=write_html_report(directory), **ENGLISH).page
    page.get_by_label("Feature").select_option("torus")
    assert len(shown(page)) == 5
    assert page.locator(".matrix tbody tr:visible").count() == 1


def test_a_clause_chooses_scenes_that_find_its_faults(visit: Any, tmp_path: Path) -> None:
    directory = write_sample(tmp_path / "results")
    found = RESULTS.faults[0].model_copy(update={"killed_by": ("whitted-1980",), "clause": "REFR-1"})
    text = RESULTS.model_copy(update={"faults": (found,)}).model_dump_json()
    (directory / KILLS_FILE).write_text(text, encoding="utf-8")
    page = visit(path=write_html_report(directory), **ENGLISH).page
    page.locator("#filter-clause").select_option("REFR-1")
    assert page.locator(".matrix tbody tr:visible").count() == 1
    assert len(shown(page)) == 5


@pytest.mark.clause("REP-12")
def test_cells_in_trouble_are_first_and_keys_step_through_them(visit: Any) -> None:
    page = visit(**ENGLISH).page
    titles = page.locator("#causes h3 .badge").all_inner_texts()
    assert [title.split()[-1] for title in titles] == ["fail", "error", "declared", "waived"]
    page.keyboard.press("n")
    expect(page.locator("#causes .cells a").first).to_be_focused()
    page.keyboard.press("n")
    page.keyboard.press("Enter")
    expect(page.locator(".cell-title")).to_contain_text("mitsuba/path")


@pytest.mark.clause("REP-10")
def test_without_javascript_all_is_shown_and_no_dead_control(visit: Any, report: Path) -> None:
    page = visit(java_script_enabled=False).page
    assert page.locator(".matrix [data-verdict]:visible").count() == 11
    assert page.locator("input:visible, button:visible, select:visible").count() == 0
    crashed = visit(path=cell_page(report, "whitted-1980+mitsuba+path"), java_script_enabled=False).page
    crashed.locator("summary").last.click()
    assert "last line" in crashed.locator("pre.log").inner_text()


@pytest.fixture(params=["overview", "cell", "scene"])
def page_file(request: pytest.FixtureRequest, report: Path) -> Path:
    scene = report.parent / "report" / "scenes" / "lambert-sphere.html"
    return {"overview": report, "cell": cell_page(report), "scene": scene}[request.param]


def opened(visit: Any, path: Path, **options: Any) -> Page:
    page: Page = visit(path=path, **ENGLISH, **options).page
    if "cells" in path.parts:
        ready(page)
        page.get_by_text("Statistics of what is seen").click()
    return page


@pytest.mark.parametrize("width", [400, 1600])
def test_the_page_never_scrolls_sideways(visit: Any, page_file: Path, width: int) -> None:
    page = opened(visit, page_file, width=width)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    over = "all => all.filter(e => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('.scroll')).length"
    assert page.locator("body *:visible").evaluate_all(over) == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_text_is_legible_in_both_schemes(visit: Any, page_file: Path, scheme: str) -> None:
    page = opened(visit, page_file, color_scheme=scheme)
    found = page.evaluate(CONTRASTS)
    assert len(found) > 15
    assert [text for text in found if text["contrast"] < WCAG_AA] == []
    dark = page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(20, 24, 27)"
    assert dark == (scheme == "dark")


def test_the_copy_button_copies_the_command_of_its_cell(visit: Any, report: Path) -> None:
    page = opened(visit, cell_page(report))
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    button = page.locator("article > .command").get_by_role("button")
    button.click()
    expect(button).to_have_text("Copied")
    command = next(c["command"] for c in sample_document(report.parent)["cells"] if c["verdict"] == "fail")
    assert page.evaluate("navigator.clipboard.readText()") == command


def test_a_refused_clipboard_leaves_the_command_selected(visit: Any) -> None:
    page = visit(**ENGLISH).page
    page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error('refused')); }")
    button = page.locator("#run .command").get_by_role("button")
    button.click()
    expect(button).to_have_text("Selected: press Ctrl+C")
    assert page.evaluate("String(getSelection())").strip() == page.locator("#run code").inner_text()


def test_headings_descend_by_one_and_every_picture_has_its_words(visit: Any, page_file: Path) -> None:
    page = opened(visit, page_file)
    levels = page.locator("h1, h2, h3, h4, h5").evaluate_all("all => all.map(h => Number(h.tagName[1]))")
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(deeper <= level + 1 for level, deeper in pairwise(levels))
    assert page.locator("article img:not([alt]), article img[alt='']").count() == 0


def test_the_keyboard_reaches_the_matrix_and_follows_its_links(visit: Any) -> None:
    page = visit(**ENGLISH).page
    page.keyboard.press("Tab")
    expect(page.locator(".skip")).to_be_focused()
    page.keyboard.press("Enter")
    link = page.locator("table.matrix td a").first
    for _ in range(40):
        page.keyboard.press("Tab")
        if link.evaluate("e => e === document.activeElement"):
            break
    expect(link).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.locator("article.detail")).to_be_visible()


def test_the_keyboard_reaches_every_control_of_a_cell_and_focus_is_seen(visit: Any, report: Path) -> None:
    page = opened(visit, cell_page(report))
    wanted = page.locator("button:visible, select:visible, input:visible, a:visible, summary:visible, [tabindex='0']")
    count = wanted.count()
    reached = set()
    for _ in range(count + 5):
        page.keyboard.press("Tab")
        place, width = page.evaluate(
            """() => {
              const all = [...document.querySelectorAll("button, select, input, a, summary, [tabindex='0']")];
              return [all.indexOf(document.activeElement), getComputedStyle(document.activeElement).outlineStyle];
            }"""
        )
        if place >= 0:
            reached.add(place)
            assert width != "none"
    assert len(reached) >= count - 1  # the link that skips to the content is not counted as visible everywhere


def test_printed_pages_show_pictures_and_no_controls(visit: Any, report: Path) -> None:
    page = opened(visit, cell_page(report))
    page.emulate_media(media="print")
    assert page.locator(".figures img:visible").count() == 4
    assert page.locator("button:visible, select:visible").count() == 0
