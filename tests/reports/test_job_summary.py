from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from markdown_it import MarkdownIt  # rich brings it

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.job_summary import MOST_BYTES, ORDER, escaped, job_summary
from raytruth.reports.loading import load_results
from raytruth.reports.wording import WAIVED, WORDINGS, outcome, outcome_counts
from tests.reports.sample_results import FAILING_PIXEL, HOSTILE, write_sample

if TYPE_CHECKING:
    from raytruth.comparisons.records.results import Cell, Results

pytestmark = pytest.mark.clause("REP-9")

MARKDOWN = MarkdownIt("gfm-like", {"linkify": False}).enable("table")


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return load_results(write_sample(tmp_path_factory.mktemp("results")))


def rows(summary: str) -> list[str]:
    """The lines of the tables of cells."""
    return [line for line in summary.splitlines() if re.match(r"\| . \w+ \|", line) and line.count(" | ") == 3]


def copies(cell: Cell, count: int) -> tuple[Cell, ...]:
    return tuple(cell.model_copy(update={"scene": f"scene-{i}"}) for i in range(count))


def test_the_verdicts_are_counted(results: Results) -> None:
    summary = job_summary(results)
    for known, count in outcome_counts(results).items():
        line = f"| {WORDINGS[known].sign} {WORDINGS[known].word} | {count} |"
        assert (line in summary) == (count > 0)


def test_each_cell_is_one_row_and_those_that_fail_come_first(results: Results) -> None:
    found = rows(job_summary(results))
    assert len(found) == len(results.cells)
    words = [line.split("|")[1].split()[1] for line in found]
    assert words == sorted(words, key=[WORDINGS[known].word for known in ORDER].index)
    assert words[0] == "fail"


def test_only_what_asks_for_a_look_is_shown_unfolded(results: Results) -> None:
    open_part, _, folded = job_summary(results).partition("<details>")
    troubles = [Verdict.FAIL, Verdict.ERROR, Verdict.DECLARED, WAIVED]
    assert len(rows(open_part)) == sum(outcome(cell) in troubles for cell in results.cells)
    assert rows(folded)
    assert folded.rstrip().endswith("</details>")


def test_a_failure_tells_its_reason_its_worst_pixel_and_a_waiver_its_own(results: Results) -> None:
    summary = job_summary(results)
    x, y = FAILING_PIXEL
    (failing,) = (line for line in rows(summary) if line.startswith("| ✗ fail"))
    assert "lie outside their feasible sets" in failing
    assert f"Worst pixel ({x}, {y})" in failing
    (waived,) = (line for line in rows(summary) if line.startswith("| ≠ waived"))
    assert r"waived: It takes \<b\>air\</b\> for glass." in waived.replace(r"\:", ":")


@pytest.mark.clause("REP-2")
@pytest.mark.parametrize(
    "text",
    [
        HOSTILE,
        "a | b",
        "*a* _b_ **c** ~~d~~ `e` ``f``",
        "[a](https://example.org) ![b](c) [d] <https://example.org> www.example.org https://example.org",
        "<!-- a --> &lt; &#65;",
        "\\| \\\\ \\<b>",
        "$a$ $$b$$ @somebody :tada: #1",
        "a\nb\r\n\n# c\n- d\n\x1b[31m",
    ],
)
def test_any_text_is_shown_as_it_is(text: str) -> None:
    table = f"| h |\n|---|\n| {escaped(text)} |"
    _, inside = (token.children or [] for token in MARKDOWN.parse(table) if token.type == "inline")
    assert {token.type for token in inside} <= {"text", "text_special"}
    shown = "".join(token.content for token in inside)
    assert shown.split() == text.replace("\x1b", "�").split()


@pytest.mark.clause("REP-2")
def test_what_github_alone_takes_for_markup_is_escaped_too() -> None:
    assert escaped("$x$ @a :b: #1") == r"\$x\$ \@a \:b\: \#1"


def test_a_summary_is_never_larger_than_github_takes_and_says_what_it_leaves_out(results: Results) -> None:
    (failing,) = (cell for cell in results.cells if outcome(cell) == Verdict.FAIL)
    passing = next(cell for cell in results.cells if cell.verdict == Verdict.PASS)
    for cells in ((failing, 6_000), (passing, 30_000)):
        summary = job_summary(results.model_copy(update={"cells": copies(*cells)}))
        left = re.search(r"([0-9]+) more cells had no room here", summary)
        assert left is not None
        assert len(rows(summary)) + int(left[1]) == cells[1]
        assert MOST_BYTES * 0.99 < len(summary.encode()) <= MOST_BYTES
    both = results.model_copy(update={"cells": (*copies(failing, 2_000), *copies(passing, 30_000))})
    assert MOST_BYTES * 0.99 < len(job_summary(both).encode()) <= MOST_BYTES


def test_a_run_without_cells_has_a_summary_too(results: Results) -> None:
    summary = job_summary(results.model_copy(update={"cells": ()}))
    assert "No cell could be compared" in summary
    assert rows(summary) == []
