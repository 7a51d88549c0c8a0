import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Locator, Page, expect

from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.reports.html import write_html_report
from tests.browser.contrasts import CONTRASTS, WCAG_AA
from tests.reports.sample_results import (
    AMBIGUOUS_PIXEL,
    CAPPED_PIXEL,
    DECLARED_PIXEL,
    FAILING_PIXEL,
    HOSTILE,
    SIDE,
    write_sample,
)

pytestmark = pytest.mark.clause("REP-3")

UNJUDGED_PIXEL = (3, 3)
NAN_PIXEL = (41, 40)
PLAIN_PIXEL = (50, 20)
FOLDER = "cells/lambert-sphere/closed_form-local"


def failing_cell(page: Page) -> Locator:
    return page.locator("article.fail")


def stochastic_cell(page: Page) -> Locator:
    return page.locator("article").filter(has=page.locator("[data-mean]"))


def centre(cell: Locator, picture: int, pixel: tuple[int, int]) -> tuple[float, float]:
    """Where on the screen the middle of a pixel is."""
    shown = cell.locator(".frame .picture").nth(picture)
    shown.scroll_into_view_if_needed()
    box = shown.bounding_box()
    assert box is not None
    return box["x"] + (pixel[0] + 0.5) / SIDE * box["width"], box["y"] + (pixel[1] + 0.5) / SIDE * box["height"]


def point_at(cell: Locator, pixel: tuple[int, int], picture: int = 1) -> None:
    cell.page.mouse.move(*centre(cell, picture, pixel))


def expect_pixel(cell: Locator, pixel: tuple[int, int]) -> None:
    expect(cell.get_by_role("status")).to_have_text(re.compile(rf"^Pixel \({pixel[0]}, {pixel[1]}\): "))


def rows(cell: Locator) -> dict[str, list[list[str]]]:
    """The table: under each row's header the lines of its three cells."""
    table = cell.locator(".pixel tbody tr").evaluate_all(
        """all => all.map(r => [r.querySelector("th").innerText.split(/\\s+/).join(" ").trim(),
            [...r.querySelectorAll("td")].map(d => [...d.querySelectorAll(".line")].map(l => l.innerText))])"""
    )
    return dict(table)


def float32(texts: list[list[str]], line: int = 0) -> NDArray[np.float32]:
    return np.array([float(cell[line]) for cell in texts]).astype(np.float32)


def same_in_nine_digits(texts: list[list[str]], line: int, values: NDArray[np.float32]) -> None:
    np.testing.assert_array_equal(float32(texts, line), values)


@pytest.mark.parametrize("picture", [0, 1, 2, 3])
def test_pointing_at_a_pixel_of_any_picture_shows_its_exact_numbers(visit: Any, report: Path, picture: int) -> None:
    cell = failing_cell(visit().page)
    for pixel in (PLAIN_PIXEL, FAILING_PIXEL, (SIDE - 1, SIDE - 1)):
        point_at(cell, pixel, picture)
        expect_pixel(cell, pixel)
        x, y = pixel
        shown = rows(cell)
        results = report.parent / FOLDER
        evidence = read_pixel_evidence(results / "feasible.exr")
        same_in_nine_digits(shown["Value"], 0, read_image(results / "render.exr")[y, x])
        same_in_nine_digits(shown["Truth"], 0, read_image(results / "truth.exr")[y, x])
        same_in_nine_digits(shown["from to"], 0, evidence.low[y, x, 0])
        same_in_nine_digits(shown["from to"], 1, evidence.high[y, x, 0])


def test_a_failing_pixel_is_told_as_such_with_its_distance(visit: Any) -> None:
    cell = failing_cell(visit().page)
    point_at(cell, FAILING_PIXEL)
    expect(cell.get_by_role("status")).to_have_text(
        "Pixel (20, 12): ✗ outside its feasible interval, 300 tolerances from the middle."
    )
    assert rows(cell)["Distance"] == [["✗ 300"]] * 3


def test_of_several_outcomes_the_one_that_holds_the_value_is_marked(visit: Any) -> None:
    cell = failing_cell(visit().page)
    point_at(cell, AMBIGUOUS_PIXEL)
    expect(cell.get_by_role("status")).to_contain_text("✓ within its 3 feasible outcomes")
    headers = list(rows(cell))
    assert headers[-3:] == ["1", "2 ✓", "3"]
    assert headers[-4] == "3 feasible outcomes, from … to (✓ holds the value)"
    assert cell.locator("tr.nearest th").inner_text().strip() == "2 ✓"


def test_what_is_not_judged_or_no_number_is_told(visit: Any) -> None:
    cell = failing_cell(visit().page)
    point_at(cell, UNJUDGED_PIXEL)
    expect(cell.get_by_role("status")).to_contain_text("(3, 3): not judged")
    assert list(rows(cell)) == ["Value", "Truth"]
    point_at(cell, NAN_PIXEL)
    expect_pixel(cell, NAN_PIXEL)
    shown = rows(cell)
    assert shown["Value"] == [["not a number"]] * 3
    assert shown["Distance"] == [["✗ infinite"]] * 3


def test_a_capped_pixel_says_that_its_box_holds_several_outcomes(visit: Any) -> None:
    cell = failing_cell(visit().page)
    point_at(cell, CAPPED_PIXEL)
    expect(cell.get_by_role("status")).to_contain_text("capped: there are more outcomes than are told apart")


@pytest.mark.clause("VER-14")
def test_a_pixel_that_is_as_declared_says_so(visit: Any) -> None:
    cell = visit().page.locator("article.declared")
    point_at(cell, DECLARED_PIXEL)
    expect(cell.get_by_role("status")).to_contain_text("◐ as declared, not as due")
    point_at(cell, PLAIN_PIXEL)
    expect(cell.get_by_role("status")).not_to_contain_text("as declared")


def test_a_stochastic_cell_shows_the_mean_and_the_interval_of_the_expectation(visit: Any) -> None:
    cell = stochastic_cell(visit().page)
    point_at(cell, PLAIN_PIXEL, picture=4)
    expect(cell.get_by_role("status")).to_contain_text("its mean is likely enough, at a distance of ")
    assert list(rows(cell)) == ["Mean", "Truth", "Distance", "Feasible interval of the expectation", "from to"]


def test_values_are_loaded_once_and_only_when_they_are_wanted(visit: Any) -> None:
    opened = visit()
    assert not [url for url in opened.requests if "/pixels/" in url]
    cell = failing_cell(opened.page)
    for pixel in (PLAIN_PIXEL, FAILING_PIXEL):
        point_at(cell, pixel)
        expect_pixel(cell, pixel)
    assert [url.split("/")[-1] for url in opened.requests if "/pixels/" in url] == [
        "lambert-sphere+closed_form+local.js"
    ]
    assert opened.complaints == []


def test_a_click_keeps_the_pixel_until_escape(visit: Any) -> None:
    page = visit().page
    cell = failing_cell(page)
    page.mouse.click(*centre(cell, 1, PLAIN_PIXEL))
    point_at(cell, FAILING_PIXEL)
    expect_pixel(cell, PLAIN_PIXEL)
    page.keyboard.press("Escape")
    point_at(cell, (21, 12))
    expect_pixel(cell, (21, 12))


def test_the_arrow_keys_step_from_the_worst_pixel_and_stay_within_the_picture(visit: Any) -> None:
    page = visit().page
    cell = failing_cell(page)
    picture = cell.get_by_role("application", name="Truth: choose a pixel with the arrow keys")
    picture.focus()
    before = page.evaluate("scrollY")
    x, y = FAILING_PIXEL
    for key, pixel in [
        ("ArrowRight", (x + 1, y)),
        ("ArrowDown", (x + 1, y + 1)),
        ("ArrowLeft", (x, y + 1)),
        ("ArrowUp", (x, y)),
        ("Shift+ArrowRight", (x + 10, y)),
        ("Shift+ArrowUp", (x + 10, y - 10)),
        ("Shift+ArrowUp", (x + 10, 0)),
        *[("Shift+ArrowRight", (min(x + 20 + 10 * step, SIDE - 1), 0)) for step in range(5)],
    ]:
        page.keyboard.press(key)
        expect_pixel(cell, pixel)
    assert page.evaluate("scrollY") == before


def test_each_cells_pictures_are_one_stop_of_the_tab_key(visit: Any) -> None:
    page = visit().page
    frames = failing_cell(page).locator(".frame")
    assert frames.evaluate_all("all => all.map(f => f.tabIndex)") == [0, -1, -1, -1]
    failing_cell(page).locator("[role=application][tabindex='0']").focus()
    page.keyboard.press("Tab")
    expect(failing_cell(page).get_by_label("x", exact=True)).to_be_focused()


def test_the_coordinates_can_be_typed(visit: Any) -> None:
    cell = failing_cell(visit().page)
    x, y = cell.get_by_label("x", exact=True), cell.get_by_label("y", exact=True)
    assert (x.input_value(), y.input_value()) == tuple(map(str, FAILING_PIXEL))
    for typed, expected in [("33", "33"), ("1000", "63"), ("-4", "0"), ("", "0"), ("2.7", "2")]:
        x.fill(typed)
        x.press("Enter")
        expect_pixel(cell, (int(expected), FAILING_PIXEL[1]))
        assert x.input_value() == expected
    y.fill("50")
    y.press("Enter")
    expect_pixel(cell, (2, 50))


def test_every_picture_of_the_cell_marks_the_pixel(visit: Any) -> None:
    cell = failing_cell(visit().page)
    point_at(cell, PLAIN_PIXEL)
    expect_pixel(cell, PLAIN_PIXEL)
    for place in range(4):
        box = cell.locator(".marker").nth(place).bounding_box()
        assert box is not None
        middle = centre(cell, place, PLAIN_PIXEL)
        box = cell.locator(".marker").nth(place).bounding_box()
        assert box is not None
        assert abs(box["x"] + box["width"] / 2 - middle[0]) < 1
        assert abs(box["y"] + box["height"] / 2 - middle[1]) < 1


def test_the_command_explains_the_pixel_and_can_be_copied(visit: Any) -> None:
    page = visit().page
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    cell = failing_cell(page)
    page.mouse.click(*centre(cell, 0, PLAIN_PIXEL))
    expect_pixel(cell, PLAIN_PIXEL)
    cell.locator(".pixel").get_by_role("button").click()
    expect(cell.locator(".pixel").get_by_role("button")).to_have_text("Copied")
    assert page.evaluate("navigator.clipboard.readText()") == "raytruth explain lambert-sphere --pixel 50,20"


def test_a_tap_on_a_narrow_screen_shows_the_numbers_in_sight(visit: Any) -> None:
    page = visit(390, has_touch=True).page
    cell = failing_cell(page)
    page.touchscreen.tap(*centre(cell, 1, AMBIGUOUS_PIXEL))
    expect_pixel(cell, AMBIGUOUS_PIXEL)
    expect(cell.locator(".pixel table")).to_be_in_viewport()
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    region = cell.locator(".pixel .scroll")
    assert region.evaluate("r => r.scrollWidth <= r.clientWidth")  # all three channels


@pytest.mark.clause("REP-4")
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_numbers_are_legible_in_both_schemes(visit: Any, scheme: str) -> None:
    page = visit(color_scheme=scheme).page
    point_at(failing_cell(page), AMBIGUOUS_PIXEL)
    expect_pixel(failing_cell(page), AMBIGUOUS_PIXEL)
    assert [text for text in page.evaluate(CONTRASTS) if text["contrast"] < WCAG_AA] == []


def own_report(tmp_path: Path) -> Path:
    return write_html_report(write_sample(tmp_path / "results"))


def test_a_report_without_its_folder_says_what_is_missing(visit: Any, tmp_path: Path) -> None:
    alone = tmp_path / "alone.html"
    alone.write_bytes(own_report(tmp_path).read_bytes())
    cell = failing_cell(visit(path=alone).page)
    point_at(cell, PLAIN_PIXEL)
    name = "pixels/lambert-sphere+closed_form+local.js"
    expect(cell.get_by_role("status")).to_have_text(
        f"The pixels’ values lie in the file {name} beside this page, which is missing."
    )
    assert cell.locator(".pixel table").is_hidden()


@pytest.mark.parametrize(
    "text",
    [
        'raytruthPixels("cell/of/another/report", {});',
        "",
        'raytruthPixels("cell/lambert-sphere/closed_form/local", {"width": 64, "height": 63});',
    ],
)
def test_values_of_another_report_are_not_shown(visit: Any, tmp_path: Path, text: str) -> None:
    path = own_report(tmp_path)
    (path.parent / "pixels/lambert-sphere+closed_form+local.js").write_text(text, encoding="utf-8")
    cell = failing_cell(visit(path=path).page)
    point_at(cell, PLAIN_PIXEL)
    expect(cell.get_by_role("status")).to_contain_text("belong to another report")


@pytest.mark.clause("REP-2")
def test_no_element_of_the_page_can_load_a_script_by_itself(visit: Any, tmp_path: Path) -> None:
    path = own_report(tmp_path)
    (path.parent / "pixels/strange.js").write_text("globalThis.strange = true;", encoding="utf-8")
    page = path.read_text(encoding="utf-8")
    path.write_text(page.replace("<main>", '<main><script src="pixels/strange.js"></script>'), encoding="utf-8")
    opened = visit(path=path)
    assert opened.page.evaluate("'strange' in globalThis") is False
    assert any("Content Security Policy" in complaint for complaint in opened.complaints)


@pytest.mark.clause("REP-2")
def test_hostile_names_of_a_scene_stay_words_of_the_command(visit: Any, tmp_path: Path) -> None:
    directory = write_sample(tmp_path / "results")
    document = json.loads((directory / "results.json").read_text(encoding="utf-8"))
    for cell in document["cells"]:
        cell["source"] = HOSTILE
    (directory / "results.json").write_text(json.dumps(document), encoding="utf-8")
    opened = visit(path=write_html_report(directory))
    failing = failing_cell(opened.page)
    point_at(failing, PLAIN_PIXEL)
    expect_pixel(failing, PLAIN_PIXEL)
    command = failing.locator(".pixel code").inner_text()
    quoted = HOSTILE.replace("'", "'\"'\"'")
    assert command == f"raytruth explain '{quoted}' --pixel 50,20"
    assert opened.complaints == []
