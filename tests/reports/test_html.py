import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest

from raytruth.comparisons.records.image_files import write_image
from raytruth.reports.html import ReportError, write_html_report, write_single_file
from raytruth.reports.kills import PAGE_FILE
from tests.reports.sample_results import HOSTILE, noise, sample_document, sphere_image, write_sample

pytestmark = pytest.mark.clause("REP-1")

Change = Callable[[dict[str, Any]], object]


@pytest.fixture
def directory(tmp_path: Path) -> Path:
    return write_sample(tmp_path / "results")


def changed(directory: Path, change: Change) -> Path:
    """The results directory with its document changed in place."""
    path = directory / "results.json"
    document = json.loads(path.read_text(encoding="utf-8"))
    change(document)
    path.write_text(json.dumps(document), encoding="utf-8")
    return directory


def pages_of(directory: Path) -> dict[str, str]:
    """All pages of the report under their addresses, the overview first."""
    path = write_html_report(directory)
    pages = [path, *sorted((directory / "report").rglob("*.html"))]
    return {page.relative_to(directory).as_posix(): page.read_text(encoding="utf-8") for page in pages}


def page_of(directory: Path) -> str:
    """All pages in a row."""
    return "\n".join(pages_of(directory).values())


def array_scripts(directory: Path) -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in (directory / "report" / "arrays").iterdir()}


def hostile(value: Any, keep: frozenset[str]) -> Any:
    """The document with every string replaced by a hostile one, but for the keys that must stay."""
    if isinstance(value, dict):
        return {key: inner if key in keep else hostile(inner, keep) for key, inner in value.items()}
    if isinstance(value, list):
        return [hostile(inner, keep) for inner in value]
    return HOSTILE if isinstance(value, str) else value


@pytest.mark.clause("REP-10")
def test_the_report_is_a_page_with_a_folder_beside_it(directory: Path) -> None:
    before = set(directory.iterdir())
    path = write_html_report(directory)
    assert path == directory / "report.html"
    assert set(directory.iterdir()) - before == {path, directory / "report"}
    cells = sample_document(directory)["cells"]
    assert len(list((directory / "report" / "cells").iterdir())) == len(cells)
    assert len(list((directory / "report" / "scenes").iterdir())) == len({cell["scene"] for cell in cells})


def test_the_report_is_a_function_of_the_results_alone(directory: Path) -> None:
    first = pages_of(directory), array_scripts(directory)
    assert (pages_of(directory), array_scripts(directory)) == first


def test_the_report_leads_to_the_kill_matrix_where_there_is_one(directory: Path) -> None:
    link = f'href="{PAGE_FILE}"'
    assert link not in write_html_report(directory).read_text(encoding="utf-8")
    (directory / PAGE_FILE).write_text("", encoding="utf-8")
    assert link in write_html_report(directory, unless_current=True).read_text(encoding="utf-8")


def test_files_of_cells_that_are_gone_go_too(directory: Path) -> None:
    page_of(directory)
    assert array_scripts(directory)
    page_of(changed(directory, lambda document: document.update(cells=[])))
    assert not (directory / "report" / "arrays").exists()
    assert list((directory / "report" / "cells").iterdir()) == []


@pytest.mark.clause("REP-10")
def test_all_that_pages_load_lies_in_the_folder(directory: Path) -> None:
    for name, page in pages_of(directory).items():
        # A person may follow a link.
        page_without_links = re.sub(r'<a href="https://[^"]*" rel="noreferrer">', "", page)
        addresses = re.findall(r'(?:src|href)="([^"]*)"', page_without_links)
        assert addresses
        for address in addresses:
            target, _, anchor = address.partition("#")
            if target:
                assert ((directory / name).parent / unquote(target)).resolve().is_file(), f"{address} on {name}"
                assert (directory / name).parent.joinpath(unquote(target)).resolve().is_relative_to(directory)
            elif anchor:
                assert f'id="{anchor}"' in page


@pytest.mark.clause("REP-2")
def test_no_string_of_the_results_can_become_markup(directory: Path) -> None:
    keep = frozenset({"verdict", "images", "log", "link"})
    log = next(directory.rglob("log.txt"))
    log.write_text(HOSTILE, encoding="utf-8")

    def poison(document: dict[str, Any]) -> None:
        document.update(hostile(document, keep))
        document["machine"] = {HOSTILE: HOSTILE}
        for i, scene in enumerate(document["scenes"]):
            scene["name"] += str(i)
        for i, renderer in enumerate(document["renderers"]):
            renderer["name"] += str(i)
            renderer["integrators"] = {HOSTILE: HOSTILE}
        for i, cell in enumerate(document["cells"]):
            cell["scene"] += "0"
            cell["renderer"] += "0"
            cell["integrator"] += str(i)
        document["cells"][0]["images"]["truth"] = HOSTILE
        document["cells"][0]["log"] = HOSTILE

    clean, page = page_of(directory), page_of(changed(directory, poison))
    assert "&lt;script&gt;alert(" in page
    assert "{{ 7*7 }}" in page  # not evaluated
    assert page.count("<script") == clean.count("<script") - 1  # the cell without its truth has no viewer
    assert HOSTILE not in page
    assert '"&{{' not in page  # no quotation mark leaves an attribute
    for name, text in array_scripts(directory).items():
        assert "<" not in name
        assert "<" not in text
        assert re.fullmatch(r'raytruthArrays\("[\w./]*", \{[\w"+/=:,<\[\]{}\\]*\}\);\n', text)


def test_every_cell_has_its_page_and_ids_are_there_once(directory: Path) -> None:
    cells = sample_document(directory)["cells"]
    pages = pages_of(directory)
    for page in pages.values():
        ids = re.findall(r'\bid="([^"]*)"', page)
        assert len(ids) == len(set(ids))
    goals = set(re.findall(r'href="(report/cells/[^"]*)"', pages["report.html"]))
    assert len(goals) == len(cells)


def test_a_scenes_truth_is_stored_once(directory: Path) -> None:
    pages = pages_of(directory)
    shown = re.findall(r'src="([^"]*)" alt="Truth of', "".join(pages.values()))
    assert len(shown) > 6
    assert len({Path(address).name for address in shown}) == 1  # the sample's scenes share one truth


@pytest.mark.clause("REP-10")
def test_one_file_can_hold_all_of_it(directory: Path) -> None:
    page = write_single_file(directory).read_text(encoding="utf-8")
    addresses = re.findall(r'(?:src|href)="([^"]*)"', re.sub(r'<a href="https://[^"]*"', "", page))
    assert all(address.startswith(("#", "data:")) for address in addresses)
    assert page.count("<article") == len(sample_document(directory)["cells"])
    assert page.count('<script type="application/json" id="arrays/') > 5
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert {address[1:] for address in addresses if address.startswith("#")} <= set(ids)
    assert len(ids) == len(set(ids))


@pytest.mark.clause("REP-2")
def test_names_longer_than_files_have_are_cut_and_told_apart(directory: Path) -> None:
    long = "n" * 1_000_000

    def rename(document: dict[str, Any]) -> None:
        for scene, name in zip(document["scenes"][:2], ("a", "b"), strict=True):
            for cell in document["cells"]:
                if cell["scene"] == scene["name"]:
                    cell["scene"] = long + name
            scene["name"] = long + name

    write_html_report(changed(directory, rename))
    assert len(list((directory / "report" / "cells").iterdir())) == len(sample_document(directory)["cells"])


@pytest.mark.clause("REP-12")
def test_cells_that_fail_come_first_and_what_changed_is_told(directory: Path, tmp_path: Path) -> None:
    earlier = write_sample(tmp_path / "earlier")

    def fail(document: dict[str, Any]) -> None:
        document["cells"][0]["verdict"] = "fail"
        document["cells"].pop()

    page = write_html_report(changed(directory, fail), against=earlier).read_text(encoding="utf-8")
    assert page.index("What needs a look") < page.index("What changed") < page.index("<table")
    told = page[page.index("What changed</h2>") : page.index("Matrix</h2>")]
    assert "Failed now, and did not before" in told
    assert "In the earlier results only" in told
    assert "Another verdict" not in told
    with pytest.raises(ReportError, match="There is no results directory"):
        write_html_report(directory, against=tmp_path / "nowhere")


def test_a_missing_image_is_told_in_its_cell_and_the_rest_is_built(directory: Path) -> None:
    page = page_of(directory)
    assert "The image cells/odd name-&lt;b&gt;%20ü/mitsuba-path/render.exr is missing." in page
    assert page.count("<article") == len(sample_document(directory)["cells"])


def test_a_broken_image_is_told_in_its_cell(directory: Path) -> None:
    (directory / "cells/lambert-sphere/mitsuba-direct/tolerances.exr").write_bytes(b"not an image")
    assert "expected an OpenEXR image" in page_of(directory)


def test_a_render_of_another_size_is_told_in_its_cell(directory: Path) -> None:
    write_image(directory / "cells/lambert-sphere/mitsuba-direct/render.exr", sphere_image()[:-1].copy())
    assert "The render is 64×63 pixels large, the truth 64×64." in page_of(directory)


def test_an_image_with_other_channels_is_told_in_its_cell(directory: Path) -> None:
    write_image(directory / "cells/lambert-sphere/mitsuba-direct/grey.exr", noise())

    def swap(document: dict[str, Any]) -> None:
        document["cells"][0]["images"]["render"] = "cells/lambert-sphere/mitsuba-direct/grey.exr"

    assert "has one channel" in page_of(changed(directory, swap))


@pytest.mark.clause("REP-2")
def test_a_log_is_shown_from_its_end_without_terminal_escapes(directory: Path) -> None:
    page = page_of(directory)
    assert "Fatal: &lt;b&gt;fminimum&lt;/b&gt;" in page
    assert "last line" in page
    assert "line 10\n" not in page
    assert "\x1b" not in page
    assert "\x07" not in page


@pytest.mark.clause("REP-2")
@pytest.mark.parametrize("outside", ["../secret.txt", "/etc/hostname", "a\0b"])
def test_a_results_file_cannot_name_files_outside_its_directory(directory: Path, outside: str) -> None:
    (directory.parent / "secret.txt").write_text("the secret", encoding="utf-8")

    def point(document: dict[str, Any]) -> None:
        document["cells"][0]["log"] = outside
        document["cells"][0]["images"]["truth"] = outside
        document["cells"][1]["images"]["feasible"] = outside

    page = page_of(changed(directory, point))
    assert "the secret" not in page
    assert "lies outside the results directory" in page or "is not the name of a file" in page


def test_the_worst_pixel_stands_beside_its_feasible_interval(directory: Path) -> None:
    page = page_of(directory)
    assert "Worst pixel: (20, 12), 300 tolerances from the nearest outcome" in page
    assert "not a finite number at 3 pixels" in page


def test_values_that_are_not_numbers_are_told_as_such(directory: Path) -> None:
    def spoil(document: dict[str, Any]) -> None:
        document["cells"][0]["judgement"]["worst"].update(value=[float("nan")] * 3, tolerances=float("inf"))

    page = page_of(changed(directory, spoil))
    assert "infinite tolerances" in page
    assert "not a number" in page


def test_optional_parts_may_all_be_missing(directory: Path) -> None:
    def strip(document: dict[str, Any]) -> None:
        required = {"scene", "renderer", "integrator", "verdict", "reason", "command"}
        document["cells"] = [{key: cell[key] for key in required} for cell in document["cells"]]

    assert 'class="figures"' not in page_of(changed(directory, strip))


def test_a_run_without_scenes_and_cells_has_a_page(directory: Path) -> None:
    page = page_of(changed(directory, lambda document: document.update(scenes=[], renderers=[], cells=[])))
    assert "No cell could be compared" in page


BROKEN: dict[str, Change] = {
    "schema_version 7": lambda document: document.update(schema_version=7),
    "the key schema_version": lambda document: document.pop("schema_version"),
    "broken at cells.0.verdict": lambda document: document["cells"][0].update(verdict="perhaps"),
    "broken at machine": lambda document: document.pop("machine"),
    "list of scenes lacks": lambda document: document["cells"][0].update(scene="elsewhere"),
    "list of renderers lacks": lambda document: document["cells"][0].update(renderer="nobody"),
    "2 times": lambda document: document["cells"].append(document["cells"][0]),
}


@pytest.mark.parametrize("expected", BROKEN)
def test_broken_results_get_one_sentence_and_no_report(directory: Path, expected: str) -> None:
    with pytest.raises(ReportError, match=re.escape(expected)) as caught:
        write_html_report(changed(directory, BROKEN[expected]))
    assert "\n" not in str(caught.value)
    assert not (directory / "report.html").exists()


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "\udcff", "[" * 100_000])
def test_a_results_file_that_is_no_json_object_gets_one_sentence(directory: Path, text: str) -> None:
    (directory / "results.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(ReportError, match=r"results\.json is not"):
        write_html_report(directory)


def test_a_missing_directory_or_results_file_gets_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(ReportError, match="There is no results directory"):
        write_html_report(tmp_path / "nowhere")
    with pytest.raises(ReportError, match=r"holds no results\.json"):
        write_html_report(tmp_path)


def test_a_page_that_cannot_be_written_leaves_nothing_behind(directory: Path) -> None:
    (directory / "report.html").mkdir()
    before = set(directory.iterdir())
    with pytest.raises(ReportError, match="cannot be written"):
        write_html_report(directory)
    assert set(directory.iterdir()) == before
