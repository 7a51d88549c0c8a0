import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect

from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.reference_tracer.pixel_proof import pixel_proof
from raytruth.reports.html import write_html_report
from raytruth.scenes.library import open_scene
from tests.browser.viewing import (
    STOCHASTIC,
    VIEWER,
    cell_page,
    choose,
    drawn,
    expect_pixel,
    float32,
    ready,
    rows,
    screen_place,
    state,
    until,
)
from tests.reports.sample_results import (
    AMBIGUOUS_PIXEL,
    CAPPED_PIXEL,
    DECLARED_PIXEL,
    FAILING_PIXEL,
    HOSTILE,
    SIDE,
    sample_document,
    write_sample,
)

pytestmark = pytest.mark.clause("REP-3")

UNJUDGED_PIXEL = (3, 3)
NAN_PIXEL = (41, 40)
PLAIN_PIXEL = (50, 20)
FOLDER = "cells/lambert-sphere/closed_form-local"
MAGENTA, BLACK = [255, 0, 255], [0, 0, 0]
ENGLISH = {"locale": "en-GB"}


def test_values_are_those_of_the_files_at_random_pixels_of_all_cells(opened: Any, report: Path) -> None:
    cells = [cell for cell in sample_document(report.parent)["cells"] if "images" in cell][:-1]  # one lacks its render
    numbers = np.random.default_rng(5)
    for cell in cells:
        page = opened(f"{cell['scene']}+{cell['renderer']}+{cell['integrator']}")
        paths = cell["images"]
        render, truth, distances = (
            read_image(report.parent / paths[name]) for name in ("render", "truth", "tolerances")
        )
        evidence = read_pixel_evidence(report.parent / paths["feasible"])
        for x, y in [NAN_PIXEL, FAILING_PIXEL, *numbers.integers(0, SIDE, (12, 2)).tolist()]:
            page.evaluate(f"([x, y]) => choosePixel({VIEWER}, x, y)", [x, y])
            expect_pixel(page, x, y)
            shown = rows(page)
            np.testing.assert_array_equal(float32(shown.get("Value") or shown["Mean"]), render[y, x])
            np.testing.assert_array_equal(float32(shown["Truth"]), truth[y, x])
            if "from to" in shown:
                np.testing.assert_array_equal(float32(shown["from to"], 0), evidence.low[y, x, 0])
                np.testing.assert_array_equal(float32(shown["from to"], 1), evidence.high[y, x, 0])
            assert ("Distance" in shown) == (distances[y, x, 0] >= 0)


def test_pointing_at_a_pixel_shows_it_and_a_click_keeps_it_until_escape(opened: Any) -> None:
    page = opened()
    page.mouse.move(*screen_place(page, *PLAIN_PIXEL))
    expect_pixel(page, *PLAIN_PIXEL)
    page.mouse.click(*screen_place(page, *FAILING_PIXEL))
    before = state(page)["view"]
    page.mouse.move(*screen_place(page, *PLAIN_PIXEL))
    drawn(page)
    expect_pixel(page, *FAILING_PIXEL)
    assert state(page)["view"] == before  # a click never loses the place
    page.keyboard.press("Escape")
    page.mouse.move(*screen_place(page, 21, 12))
    expect_pixel(page, 21, 12)


def test_a_failing_pixel_is_told_as_such_with_its_distance_and_bits(opened: Any) -> None:
    page = opened()
    choose(page, *FAILING_PIXEL)
    expect(page.locator(".outcome")).to_have_text(
        "Pixel (20, 12): ✗ outside its feasible interval, 300 tolerances from the middle."
    )
    shown = rows(page)
    assert shown["Distance"] == [["✗ 300"]] * 3
    assert shown["Bits of error"] == [["23.0"]] * 3  # half the value is a whole binade of 2**23 floats away
    choose(page, *AMBIGUOUS_PIXEL)
    assert rows(page)["Bits of error"] == [["0.0"]] * 3


def test_of_several_outcomes_the_one_that_holds_the_value_is_marked(opened: Any) -> None:
    page = opened()
    choose(page, *AMBIGUOUS_PIXEL)
    expect(page.locator(".outcome")).to_contain_text("✓ within its 3 feasible outcomes")
    headers = list(rows(page))
    assert headers[-3:] == ["1", "2 ✓", "3"]
    assert headers[-4] == "3 feasible outcomes, from … to (✓ holds the value)"


def test_what_is_not_judged_or_no_number_or_capped_or_declared_is_told(opened: Any) -> None:
    page = opened()
    for pixel, words in [
        (UNJUDGED_PIXEL, "not judged, since the renderer’s arithmetic leaves everything open"),
        (NAN_PIXEL, "infinite tolerances"),
        (CAPPED_PIXEL, "capped: there are more outcomes than are told apart"),
    ]:
        choose(page, *pixel)
        expect(page.locator(".outcome")).to_contain_text(words)
    choose(page, *NAN_PIXEL)
    assert rows(page)["Value"] == [["not a number"]] * 3
    declared = opened("whitted-1980+povray+trace")
    choose(declared, *DECLARED_PIXEL)
    expect(declared.locator(".outcome")).to_contain_text("◐ as declared, not as due")


def test_a_mean_is_told_as_one(opened: Any) -> None:
    page = opened(STOCHASTIC)
    choose(page, *PLAIN_PIXEL)
    expect(page.locator(".outcome")).to_contain_text("its mean is likely enough, at a distance of ")
    assert {"Mean", "Feasible interval of the expectation"} <= set(rows(page))
    assert page.get_by_role("button", name="Standard deviation").count() == 1


@pytest.mark.clause("REP-10")
def test_another_renderers_image_is_loaded_when_it_is_chosen(visit: Any, report: Path) -> None:
    opened = visit(path=cell_page(report), **ENGLISH)
    page = ready(opened.page)
    before = len([url for url in opened.requests if "/arrays/" in url])
    page.get_by_label("Another renderer").select_option(label="mitsuba/direct")
    until(page, f"{VIEWER}.current.startsWith('other')")
    drawn(page)
    assert len([url for url in opened.requests if "/arrays/" in url]) == before + 1
    render = read_image(report.parent / "cells/lambert-sphere/mitsuba-direct/render.exr")
    choose(page, *PLAIN_PIXEL)
    shown = float32(rows(page)["mitsuba/direct"])
    np.testing.assert_array_equal(shown, render[PLAIN_PIXEL[1], PLAIN_PIXEL[0]])


def test_the_command_explains_the_pixel_and_can_be_copied(opened: Any) -> None:
    page = opened()
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    choose(page, *PLAIN_PIXEL)
    button = page.locator(".pixel").get_by_role("button")
    button.click()
    expect(button).to_have_text("Copied")
    assert page.evaluate("navigator.clipboard.readText()") == "raytruth explain lambert-sphere --pixel 50,20"


def test_typed_coordinates_stay_within_the_picture(opened: Any) -> None:
    page = opened()
    x = page.get_by_label("x", exact=True)
    for typed, expected in [("33", "33"), ("1000", "63"), ("-4", "0"), ("", "0"), ("2.7", "2")]:
        x.fill(typed)
        x.press("Enter")
        expect_pixel(page, int(expected), FAILING_PIXEL[1])
        assert x.input_value() == expected


@pytest.mark.clause("REP-4")
def test_a_live_region_reads_the_pixel(opened: Any) -> None:
    page = opened()
    choose(page, *FAILING_PIXEL)
    expect(page.locator(".pixel > [role=status]")).to_contain_text(
        "Value 0.336, 0.228, 0.119; truth 0.673, 0.455, 0.238."
    )


@pytest.mark.clause("REP-4")
def test_a_tap_on_a_narrow_screen_shows_all_numbers(opened: Any) -> None:
    page = opened(width=390, has_touch=True)
    page.touchscreen.tap(*screen_place(page, *AMBIGUOUS_PIXEL))
    expect_pixel(page, *AMBIGUOUS_PIXEL)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    region = page.locator(".pixel .scroll")
    assert region.evaluate("r => r.scrollWidth <= r.clientWidth")  # all three channels


def own_report(tmp_path: Path) -> Path:
    return write_html_report(write_sample(tmp_path / "results"))


@pytest.mark.clause("REP-1")
def test_a_page_whose_arrays_are_missing_says_so_and_keeps_its_pictures(visit: Any, tmp_path: Path) -> None:
    path = own_report(tmp_path)
    for script in (path.parent / "report" / "arrays").iterdir():
        script.unlink()
    page = visit(path=cell_page(path), **ENGLISH).page
    expect(page.get_by_role("alert")).to_have_text(
        re.compile(r"^The pixels’ values lie in the file arrays/\w+\.js of the report’s folder, which is missing\.$")
    )
    assert page.locator(".figures img:visible").count() == 4


@pytest.mark.parametrize("text", ["", 'raytruthArrays("another", {});'])
def test_arrays_that_deliver_something_else_are_not_shown(visit: Any, tmp_path: Path, text: str) -> None:
    path = own_report(tmp_path)
    for script in (path.parent / "report" / "arrays").iterdir():
        script.write_text(text, encoding="utf-8")
    page = visit(path=cell_page(path), **ENGLISH).page
    expect(page.get_by_role("alert")).to_contain_text("holds no values: build the report again")


@pytest.mark.clause("REP-2")
def test_hostile_words_stay_words(visit: Any, tmp_path: Path) -> None:
    directory = write_sample(tmp_path / "results")
    document = json.loads((directory / "results.json").read_text(encoding="utf-8"))
    for cell in document["cells"]:
        cell["source"] = cell["reason"] = HOSTILE
    for scene in document["scenes"]:
        scene["purpose"] = HOSTILE
    (directory / "results.json").write_text(json.dumps(document), encoding="utf-8")
    opened = visit(path=cell_page(write_html_report(directory)), **ENGLISH)
    page = ready(opened.page)
    choose(page, *PLAIN_PIXEL)
    quoted = HOSTILE.replace("'", "'\"'\"'")
    assert page.locator(".pixel code").inner_text() == f"raytruth explain '{quoted}' --pixel 50,20"
    assert page.locator("p.reason").first.inner_text() == HOSTILE
    assert opened.complaints == []


@pytest.fixture(scope="module")
def proof_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("proof") / "proof.json"
    path.write_text(pixel_proof(open_scene("glass-sphere"), 32, 32).model_dump_json(), encoding="utf-8")
    return path


@pytest.mark.clause("REP-14")
def test_a_proof_is_opened_as_a_tree_whose_terms_are_there(opened: Any, proof_file: Path) -> None:
    page = opened()
    page.get_by_text("Ray tree").click()
    page.locator("input[type=file]").set_input_files(proof_file)
    rays = json.loads(proof_file.read_text(encoding="utf-8"))["explanation"]["rays"]
    expect(page.locator(".tree li:not(.soft)")).to_have_count(len(rays))
    expect_pixel(page, 32, 32)
    for child in [ray for ray in rays if ray["parent"] is not None][:4]:
        kind = {"reflected": "reflected ray", "transmitted": "transmitted ray"}[child["kind"]]
        assert page.locator(".tree li li:not(.soft) > span:first-child").filter(has_text=kind).count() > 0
    assert page.locator(".tree > li").count() == 1
    expect(page.locator(".pixel details p")).to_contain_text("Sum of all contributions: (0.415, 0.452, 0.577)")


@pytest.mark.clause("REP-2", "REP-14")
@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", "{}", '{"low": [], "high": [], "explanation": {"sum": [1], "rays": [{}]}}', "\0"],
)
def test_another_file_is_told_to_be_no_proof(opened: Any, tmp_path: Path, text: str) -> None:
    (tmp_path / "other.json").write_text(text, encoding="utf-8")
    page = opened()
    page.get_by_text("Ray tree").click()
    page.locator("input[type=file]").set_input_files(tmp_path / "other.json")
    expect(page.locator(".pixel details .problem")).to_have_text("The file is no proof of a pixel.")


@pytest.mark.clause("REP-2", "REP-14")
def test_hostile_words_of_a_proof_stay_words(visit: Any, report: Path, proof_file: Path, tmp_path: Path) -> None:
    text = proof_file.read_text(encoding="utf-8")
    document = json.loads(text)
    hostile = "<img src=x onerror=alert(1)>"
    for ray in document["explanation"]["rays"]:
        if ray["hit"]:
            ray["hit"]["material"] = hostile
    (tmp_path / "hostile.json").write_text(json.dumps(document), encoding="utf-8")
    visited = visit(path=cell_page(report), locale="en-GB")
    page = ready(visited.page)
    page.get_by_text("Ray tree").click()
    page.locator("input[type=file]").set_input_files(tmp_path / "hostile.json")
    expect(page.locator(".tree li").first).to_contain_text(hostile)
    assert page.locator(".tree img").count() == 0
    assert visited.complaints == []
