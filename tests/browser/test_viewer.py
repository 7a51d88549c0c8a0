import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from raytruth.comparisons.records.image_files import read_image
from raytruth.reports.html import write_single_file
from tests.browser.viewing import (
    VIEWER,
    cell_page,
    colour_of,
    drawn,
    expect_pixel,
    press,
    ready,
    rows,
    screen_place,
    state,
    until,
)
from tests.reports.sample_results import (
    FAILING_PIXEL,
    SIDE,
    write_sample,
)

pytestmark = pytest.mark.clause("REP-3", "REP-11")

UNJUDGED_PIXEL = (3, 3)
NAN_PIXEL = (41, 40)
PLAIN_PIXEL = (50, 20)
FOLDER = "cells/lambert-sphere/closed_form-local"
MAGENTA, BLACK = [255, 0, 255], [0, 0, 0]
ENGLISH = {"locale": "en-GB"}


def focus(page: Page) -> Page:
    page.locator(".stage").focus()
    return page


def test_number_keys_flip_between_layers_in_place(opened: Any) -> None:
    page = focus(opened())
    press(page, "z")
    view = state(page)["view"]
    dark, light = [], []
    for key, layer in zip("123456", ("truth", "render", "tolerance", "signed", "absolute", "relative"), strict=True):
        press(page, key)
        assert state(page)["current"] == layer
        (light if layer == "truth" else dark).append(colour_of(page, *FAILING_PIXEL))
        assert page.locator(".layers [aria-pressed=true]").count() == 1
    assert state(page)["view"] == view
    assert light[0] not in dark
    press(page, "1", "2", " ")
    assert state(page)["current"] == "truth"
    press(page, " ")
    assert state(page)["current"] == "render"


def test_holding_a_key_shows_the_truth_until_it_is_let_go(opened: Any) -> None:
    page = focus(opened())
    press(page, "2")
    wrong = colour_of(page, *PLAIN_PIXEL), colour_of(page, FAILING_PIXEL[0] - 2, FAILING_PIXEL[1])
    page.keyboard.down("t")
    drawn(page)
    held = colour_of(page, *PLAIN_PIXEL), colour_of(page, FAILING_PIXEL[0] - 2, FAILING_PIXEL[1])
    page.keyboard.up("t")
    drawn(page)
    assert held[0] == wrong[0]
    assert held[1] != wrong[1]
    assert colour_of(page, FAILING_PIXEL[0] - 2, FAILING_PIXEL[1]) == wrong[1]


def test_arrow_keys_step_within_the_picture_and_the_page_does_not_scroll(opened: Any) -> None:
    page = focus(opened())
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
    ]:
        page.keyboard.press(key)
        expect_pixel(page, *pixel)
    assert page.evaluate("scrollY") == before


def test_zoom_keeps_the_pixel_in_its_place_and_shows_numbers(opened: Any) -> None:
    page = focus(opened())
    fitted = state(page)["view"]["scale"]
    place = screen_place(page, *FAILING_PIXEL)
    press(page, "+")
    assert state(page)["view"]["scale"] == 2 * fitted
    assert np.allclose(screen_place(page, *FAILING_PIXEL), place, atol=1)
    press(page, "z")
    drawn_lines = page.evaluate(
        f"linesOf(layerOf({VIEWER}, 'render'), {FAILING_PIXEL[1]} * {SIDE} + {FAILING_PIXEL[0]})"
    )
    assert drawn_lines == [str(float(f"{float(line[0]):.4g}")) for line in rows(page)["Value"]]
    press(page, "0")
    assert state(page)["view"]["scale"] == fitted


def test_panning_needs_no_dragging_and_dragging_works(opened: Any) -> None:
    page = focus(opened())
    press(page, "z")
    at = state(page)["view"]
    page.get_by_role("button", name="Look to the right").click()
    drawn(page)
    assert state(page)["view"]["x"] > at["x"]
    before = state(page)["view"]["x"]
    x, y = screen_place(page, *FAILING_PIXEL)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 50, y, steps=4)
    page.mouse.up()
    drawn(page)
    after = state(page)
    assert after["view"]["x"] == pytest.approx(before + 50 / after["view"]["scale"])


def test_all_panes_side_by_side_show_the_same_place(opened: Any) -> None:
    page = focus(opened())
    press(page, "4", "v", "v")
    assert page.locator(".pane").count() == 3
    assert page.locator(".pane-label").all_inner_texts() == ["Truth", "Render", "Signed difference"]
    press(page, "z")
    colours = [colour_of(page, *FAILING_PIXEL, pane=pane) for pane in range(3)]
    assert len({tuple(colour) for colour in colours}) == 3


def test_the_slider_divides_two_layers(opened: Any) -> None:
    page = focus(opened())
    press(page, "1", "2", "v")
    assert page.locator(".pane-label").inner_text() == "Truth | Render"
    truth = colour_of(page, FAILING_PIXEL[0] - 2, FAILING_PIXEL[1])
    press(page, *["["] * 10)
    assert state(page)["divider"] == 0
    assert colour_of(page, FAILING_PIXEL[0] - 2, FAILING_PIXEL[1]) != truth


def test_failing_regions_are_listed_worst_first_and_reached_by_a_key(opened: Any) -> None:
    page = focus(opened())
    assert page.locator(".regions button").all_inner_texts() == [
        "3 pixels, worst (40, 40): infinite tolerances",
        "144 pixels, worst (14, 6): 300 tolerances",
    ]
    press(page, "n")
    expect_pixel(page, 40, 40)
    press(page, "n")
    expect_pixel(page, 14, 6)
    press(page, "p")
    expect_pixel(page, 40, 40)


def test_the_mask_shows_what_fails_if_the_tolerance_were_another(opened: Any) -> None:
    page = focus(opened())
    press(page, "m")
    assert colour_of(page, 14, 6) in (MAGENTA, BLACK)
    assert colour_of(page, *PLAIN_PIXEL) not in (MAGENTA, BLACK)
    slider = page.get_by_label("If the tolerance were")
    slider.fill("36")  # 2**(36/4) = 512 > 300
    drawn(page)
    assert colour_of(page, 14, 6) not in (MAGENTA, BLACK)
    expect(
        page.get_by_text("3 pixels in 1 regions would fail if the tolerance were 512 times as large.")
    ).to_be_visible()
    slider.fill("-16")
    drawn(page)
    count = int((np.maximum(page.evaluate(f"[...{VIEWER}.arrays.distance]"), 0).reshape(-1, 3).max(1) > 1 / 16).sum())
    expect(page.get_by_text(re.compile(f"^{count} pixels in"))).to_be_visible()


def test_exposure_curve_and_false_colour_change_images_and_not_differences(opened: Any) -> None:
    page = focus(opened())
    press(page, "2")
    seen = [colour_of(page, *PLAIN_PIXEL)]
    press(page, "e", "e")
    seen.append(colour_of(page, *PLAIN_PIXEL))
    page.get_by_label("Curve").select_option("1")
    drawn(page)
    seen.append(colour_of(page, *PLAIN_PIXEL))
    press(page, "f")
    seen.append(colour_of(page, *PLAIN_PIXEL))
    assert len({tuple(colour) for colour in seen}) == 4
    assert sum(seen[1]) > sum(seen[0])
    press(page, "4")
    before = colour_of(page, *FAILING_PIXEL)
    press(page, "E", "E")
    assert colour_of(page, FAILING_PIXEL[0], FAILING_PIXEL[1]) == before


@pytest.mark.clause("REP-5")
def test_colours_mean_what_the_scale_bar_says(opened: Any) -> None:
    page = focus(opened())
    for key, kind in [("3", "symmetric"), ("4", "linear"), ("5", "logarithmic")]:
        press(page, key)
        found = page.evaluate(
            f"""(kind) => {{
              const viewer = {VIEWER};
              const layer = layerOf(viewer, viewer.current);
              const scale = scaleOf(layer, viewer.settings);
              if (scale.kind !== kind) throw new Error(scale.kind);
              const places = [0, 0.1, 0.25, 0.5, 0.75, 0.9, 1];
              return places.map((place) => position(valueAt(place, scale), scale) - place);
            }}""",
            kind,
        )
        assert np.abs(found).max() < 1e-6  # of a colour table of 256
        marks = page.locator(".scale-bar .marks span").all_inner_texts()
        assert len(marks) == (4 if key == "3" else 5)
        if key == "3":
            assert marks == ["-300", "-1", "1", "300"]
    press(page, "3")
    assert [words.strip() for words in page.locator(".scale-bar .key").all_inner_texts()] == ["infinite", "not judged"]
    assert colour_of(page, *UNJUDGED_PIXEL) in ([140, 140, 140], [217, 217, 217])


def test_statistics_are_of_what_is_seen_and_set_infinities_aside(opened: Any, report: Path) -> None:
    page = focus(opened())
    page.get_by_text("Statistics of what is seen").click()
    table = page.locator(".panels details table")
    expect(table).to_contain_text("Columns 0 to 63, rows 0 to 63")
    render = read_image(report.parent / FOLDER / "render.exr")
    finite = render[..., 0][np.isfinite(render[..., 0])].astype(float)
    found = dict(
        table.locator("tbody tr").evaluate_all("all => all.map(r => [r.cells[0].innerText, r.cells[1].innerText])")
    )
    assert float(found["mean"]) == pytest.approx(finite.mean(), rel=5e-3)  # three digits
    assert float(found["largest"]) == pytest.approx(finite.max(), rel=5e-3)
    assert found["not finite, set aside"] == "3"
    focus(page)
    press(page, "z")
    expect(table).not_to_contain_text("Columns 0 to 63")


@pytest.mark.parametrize("layer", ["truth", "render", "tolerance", "signed", "absolute", "relative"])
def test_webgl_and_canvas_draw_the_same_picture(visit: Any, report: Path, browser_with_webgl: Any, layer: str) -> None:
    pictures = []
    for painter in ("canvas", "webgl"):
        path = cell_page(report)
        after = f"?painter={painter}#layer={layer}"
        page = ready(visit(path=path, after=after, by=browser_with_webgl, **ENGLISH).page)
        assert page.evaluate(f"{VIEWER}.painter.name").lower() == painter
        pictures.append([colour_of(page, x, y) for y in range(0, SIDE, 3) for x in range(0, SIDE, 3)])
    first, second = map(np.array, pictures)
    assert len(np.unique(first, axis=0)) > 2  # not blank, and more than the mark of the pixel
    # Formulas in float64 and in the shader's float32 may round to neighbours of the 256 colours.
    assert np.abs(first - second).max() <= 6
    assert (np.abs(first - second).max(axis=1) <= 1).mean() > 0.99


def test_the_palette_finds_and_runs_every_command(opened: Any) -> None:
    page = focus(opened())
    before = state(page)["view"]["scale"]
    page.keyboard.press("Control+k")
    page.keyboard.type("zoom in")
    page.keyboard.press("Enter")
    drawn(page)
    assert state(page)["view"]["scale"] == 2 * before
    expect(page.locator("dialog")).to_be_hidden()
    page.keyboard.press("?")
    names = page.locator("dialog li button").all_inner_texts()
    assert len(names) > 35
    page.keyboard.press("ArrowDown")
    expect(page.locator("dialog li button").first).to_be_focused()
    page.keyboard.press("Escape")
    expect(page.locator("dialog")).to_be_hidden()


def test_the_address_leads_back_to_pixel_layer_and_view(opened: Any, visit: Any, report: Path) -> None:
    page = focus(opened())
    press(page, "4", "v", "n", "z")
    until(page, "location.hash.includes('view=')")
    page.wait_for_timeout(400)
    left = state(page)
    again = ready(visit(path=cell_page(report), after=page.evaluate("location.hash"), **ENGLISH).page)
    found = state(again)
    for name in ("current", "mode", "pixel"):
        assert found[name] == left[name]
    assert found["view"] == pytest.approx(left["view"], abs=0.01)


@pytest.mark.parametrize(
    "after", ["#pixel=1e9,-5&layer=nothing&mode=x&view=a,b", "#view=0,0,0", "#pixel=,&view=NaN,1,1", "#%%%"]
)
def test_an_address_that_makes_no_sense_does_no_harm(visit: Any, report: Path, after: str) -> None:
    opened = visit(path=cell_page(report), after=after, **ENGLISH)
    found = state(ready(opened.page))
    assert 0 <= found["pixel"]["x"] < SIDE
    assert 0 <= found["pixel"]["y"] < SIDE
    assert opened.complaints == []


@pytest.mark.clause("REP-10")
def test_the_viewer_works_in_a_single_file(visit: Any, tmp_path: Path) -> None:
    path = write_single_file(write_sample(tmp_path / "results"))
    opened = visit(path=path, **ENGLISH)
    page = opened.page
    page.locator("article.fail").scroll_into_view_if_needed()
    until(page, "document.querySelector('article.fail .viewer').viewer !== undefined")
    expect(page.locator("article.fail .outcome")).to_contain_text("Pixel (20, 12): ✗ outside")
    assert [url for url in opened.requests if not url.startswith(("data:", "blob:"))] == [path.as_uri()]
    assert opened.complaints == []
