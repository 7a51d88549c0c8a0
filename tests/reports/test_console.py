import io
from pathlib import Path

import pytest
from rich.cells import cell_len
from rich.console import Console

from raytruth.comparisons.records.results import Results, Verdict
from raytruth.reports.console import print_matrix
from raytruth.reports.loading import load_results
from raytruth.reports.wording import WORDINGS, capped, outcome
from tests.reports.sample_results import write_sample

pytestmark = pytest.mark.clause("REP-6")


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return load_results(write_sample(tmp_path_factory.mktemp("results")))


def printed(results: Results, *, terminal: bool, width: int = 80, encoding: str = "utf-8") -> str:
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding=encoding)
    console = Console(file=stream, force_terminal=terminal, width=width, color_system=None)
    print_matrix(results, console, Path("/a/place/report.html"))
    stream.flush()
    return raw.getvalue().decode(encoding)


def widened(results: Results, copies: int) -> Results:
    """The same results with each renderer's columns repeated under other names."""
    renderers = [r.model_copy(update={"name": f"{r.name}-{i}"}) for i in range(copies) for r in results.renderers]
    cells = [c.model_copy(update={"renderer": f"{c.renderer}-{i}"}) for i in range(copies) for c in results.cells]
    return results.model_copy(update={"renderers": tuple(renderers), "cells": tuple(cells)})


@pytest.mark.parametrize("terminal", [True, False])
def test_counts_reasons_of_failures_and_the_report_are_printed(results: Results, terminal: bool) -> None:
    text = printed(results, terminal=terminal)
    assert (
        "11 cells: 5 passed, 1 as declared, not as due, 1 failed, 1 failed as waived, 1 incomparable, 1 unavailable"
        in text
    )
    assert "lie outside their" in text
    assert "Capped pixels: 4,104 of 32,768 pixels in 8 judged cells (12.5 %): 8 in a box of several outcomes" in text
    assert "mitsuba ended with signal 6" in text
    assert "Report: /a/place/report.html" in text


@pytest.mark.parametrize("terminal", [True, False])
def test_a_waived_failure_is_told_apart_with_its_reason(results: Results, terminal: bool) -> None:
    text = " ".join(printed(results, terminal=terminal).split())
    assert "waived whitted-1980 closed_form/local" in text
    assert "; waived: It takes <b>air</b> for glass. https://example.org/fault?a=1&b=2" in text


def test_a_terminal_gets_a_sign_for_every_cell_and_a_legend(results: Results) -> None:
    lines = printed(results, terminal=True).splitlines()
    table = "\n".join(lines[: next(i for i, line in enumerate(lines) if line.startswith("✓ pass"))])
    for known, wording in WORDINGS.items():
        assert table.count(wording.sign) == sum(outcome(cell) == known for cell in results.cells)
        assert f"{wording.sign} {wording.word}" in "\n".join(lines)


@pytest.mark.parametrize("copies", [1, 2, 4])
def test_no_line_of_the_table_exceeds_80_columns_and_no_name_is_lost(results: Results, copies: int) -> None:
    wide = widened(results, copies)
    text = printed(wide, terminal=True)
    ends = ("Report:", "cells:", "Capped pixels:", "Independent references:")  # in lines that are made to be copied
    assert max(cell_len(line) for line in text.splitlines() if not any(end in line for end in ends)) <= 80
    assert all(scene.name in text for scene in results.scenes)
    for cell in wide.cells:
        assert f"{cell.renderer}/{cell.integrator}" in text or (copies == 1 and cell.renderer in text)


def test_elsewhere_each_cell_is_one_line(results: Results) -> None:
    lines = printed(results, terminal=False, width=30).splitlines()
    assert len(lines) == len(results.cells) + 4
    assert [line.split()[0] for line in lines[:-4]] == [outcome(cell) for cell in results.cells]


@pytest.mark.parametrize("terminal", [True, False])
def test_an_output_that_knows_only_ascii_gets_words(results: Results, terminal: bool) -> None:
    assert "closed_form" in printed(results, terminal=terminal, encoding="ascii")


@pytest.mark.clause("REP-2")
@pytest.mark.parametrize("terminal", [True, False])
def test_untrusted_words_are_neither_markup_nor_terminal_escapes(results: Results, terminal: bool) -> None:
    hostile = "[red]\x1b]0;title\x07[/nothing]\r"
    cells = [
        cell.model_copy(update={"scene": hostile, "reason": hostile, "verdict": Verdict.FAIL})
        for cell in results.cells[:1]
    ]
    scenes = (results.scenes[0].model_copy(update={"name": hostile}),)
    text = printed(results.model_copy(update={"cells": tuple(cells), "scenes": scenes}), terminal=terminal)
    assert "\x1b" not in text
    assert "\x07" not in text
    assert "\r" not in text
    assert "[red]" in text
    assert "[/nothing]" in text


def test_a_run_without_cells_is_printed_too(results: Results) -> None:
    text = printed(results.model_copy(update={"cells": ()}), terminal=True)
    assert "0 cells" in text
    assert "Capped" not in text


@pytest.mark.parametrize(("merged", "unjudged"), [(0, 0), (0, 1), (1, 0), (2, 3)])
def test_capped_pixels_are_summed_over_all_judged_cells(results: Results, merged: int, unjudged: int) -> None:
    judged = [cell for cell in results.cells if cell.judgement is not None]
    assert len(judged) > 2
    cells = [
        cell.model_copy(
            update={"judgement": cell.judgement and cell.judgement.model_copy(update={"capped": 0, "unjudged": 0})}
        )
        for cell in judged
    ]
    worst = judged[1].judgement
    assert worst is not None
    capped_judgement = worst.model_copy(update={"capped": merged, "unjudged": unjudged})
    cells[1] = judged[1].model_copy(update={"judgement": capped_judgement})
    text = capped(results.model_copy(update={"cells": tuple(cells)}))
    assert text is not None
    if merged + unjudged == 0:
        assert text == f"Capped pixels: none of 32,768 pixels in {len(judged)} judged cells."
    else:
        share = 100 * (merged + unjudged) / 32_768
        assert text.startswith(f"Capped pixels: {merged + unjudged} of 32,768 pixels")
        assert f"({share:.3g} %)" in text
        assert text.endswith(f": {merged} in a box of several outcomes, {unjudged} not judged.")
