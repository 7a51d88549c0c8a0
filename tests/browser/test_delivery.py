from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from raytruth.reports.html import write_html_report
from tests.browser.static_server import JENKINS
from tests.browser.viewing import FAILING, cell_page, ready, state
from tests.reports.sample_results import write_sample

pytestmark = pytest.mark.clause("REP-10")

ENGLISH = {"locale": "en-GB"}
CELL = f"report/cells/{FAILING}.html"


def test_over_http_the_viewer_works_and_asks_that_server_only(visit: Any, served: Any) -> None:
    server = served()
    opened = visit(address=f"{server}{CELL}", **ENGLISH)
    ready(opened.page)
    expect(opened.page.locator(".outcome")).to_contain_text("Pixel (20, 12): ✗ outside")
    assert all(url.startswith(server) for url in opened.requests)
    assert opened.complaints == []


def test_arrays_are_loaded_when_a_cell_is_opened_and_pictures_are_there_before(visit: Any, report: Path) -> None:
    opened = visit(path=cell_page(report), **ENGLISH)
    assert opened.page.locator(".figures img").count() == 4
    ready(opened.page)
    assert len([url for url in opened.requests if "/arrays/" in url]) == 3
    assert opened.page.locator(".figures").is_hidden()


@pytest.mark.parametrize("address", ["report.html", CELL, "report/scenes/lambert-sphere.html"])
def test_under_jenkins_policy_verdicts_reasons_and_pictures_remain(visit: Any, served: Any, address: str) -> None:
    server = served(**JENKINS)
    opened = visit(address=f"{server}{address}", **ENGLISH)
    page = opened.page
    assert page.evaluate("typeof say") == "undefined"  # no script ran
    images = page.locator("img")
    images.last.scroll_into_view_if_needed()
    sizes = images.evaluate_all("all => all.map(i => i.naturalWidth)")
    assert sizes
    assert all(sizes)
    assert page.evaluate("getComputedStyle(document.body).maxWidth") == "1600px"  # the style was read
    if address == CELL:
        expect(page.locator(".reason").first).to_have_text("147 of 4,096 pixels lie outside their feasible sets")
        expect(page.locator(".badge").first).to_contain_text("fail")
        assert page.locator(".bar.difference").evaluate("b => getComputedStyle(b).backgroundImage") != "none"
    if address == "report.html":
        assert page.locator(".matrix [data-verdict]:visible").count() == 11
        expect(page.locator("#causes")).to_contain_text("147 of 4,096 pixels lie outside")
    refused = [text for text in opened.complaints if "script" not in text.lower()]
    assert refused == []


@pytest.mark.clause("REP-2")
def test_no_element_of_a_page_can_load_a_script_by_itself(visit: Any, tmp_path: Path) -> None:
    path = write_html_report(write_sample(tmp_path / "results"))
    (path.parent / "report" / "strange.js").write_text("globalThis.strange = true;", encoding="utf-8")
    page = path.read_text(encoding="utf-8")
    strange = '<main id="content"><script src="report/strange.js"></script>'
    assert '<main id="content">' in page
    path.write_text(page.replace('<main id="content">', strange), encoding="utf-8")
    opened = visit(path=path, **ENGLISH)
    assert opened.page.evaluate("'strange' in globalThis") is False
    assert any("Content Security Policy" in complaint for complaint in opened.complaints)


def test_an_image_without_a_single_number_is_shown_as_such(visit: Any, tmp_path: Path) -> None:
    import numpy as np  # noqa: PLC0415 - this test alone needs it

    from raytruth.comparisons.records.image_files import write_image  # noqa: PLC0415 - as above

    directory = write_sample(tmp_path / "results")
    nothing = np.full((64, 64, 3), np.nan, dtype=np.float32)
    for name in ("render", "truth", "tolerances"):
        write_image(directory / f"cells/lambert-sphere/closed_form-local/{name}.exr", nothing)
    opened = visit(path=cell_page(write_html_report(directory)), **ENGLISH)
    page = ready(opened.page)
    assert state(page)["current"] == "render"
    for key in "123456":
        page.keyboard.press(key)
    expect(page.locator(".scale-bar")).to_contain_text("not a number")
    assert opened.complaints == []
