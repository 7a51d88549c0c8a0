"""A run's outcome as Markdown, for the page that GitHub shows of a job: the counts, then the cells, the worst first.

No text of a scene, a program or a log becomes markup: whatever Markdown could take for its own is escaped.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.wording import WAIVED, WORDINGS, evidence, headline, outcome, outcome_counts, plural, printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.records.results import Cell, Results

MOST_BYTES = 1 << 20
"""GitHub refuses a step's summary that is larger ("Workflow commands for GitHub Actions", job summaries)."""
_FOOT_BYTES = 1 << 8  # for what stands below the last row

# What somebody has to look at first.
ORDER = (Verdict.FAIL, Verdict.ERROR, Verdict.DECLARED, WAIVED, Verdict.UNAVAILABLE, Verdict.INCOMPARABLE, Verdict.PASS)
_OPEN = ORDER[:4]
"""These outcomes are shown at once, the others when the reader unfolds them."""

# Of CommonMark and of what GitHub adds to it: emphasis, code, links, HTML, tables, formulas, mentions, emoji, issues.
_MARKUP = re.compile(r"[\\`*_\[\]<>&|~$@:#]|(?<=www)\.")


def job_summary(results: Results) -> str:
    """The summary in GitHub's Markdown, no larger than GitHub takes."""
    counts = [(WORDINGS[known], count) for known, count in outcome_counts(results).items() if count]
    lines = [
        f"## raytruth: {escaped(headline(results))}",
        "",
        "| verdict | cells | |",
        "|---|--:|---|",
        *(f"| {wording.sign} {wording.word} | {count} | {wording.meaning} |" for wording, count in counts),
        "",
    ]
    ordered = sorted(results.cells, key=lambda cell: ORDER.index(outcome(cell)))
    shown = [cell for cell in ordered if outcome(cell) in _OPEN]
    folded = ordered[len(shown) :]
    room = MOST_BYTES - _size(lines) - 2 * _FOOT_BYTES
    rows = _rows(shown, room)
    if shown:
        lines += [*_HEAD, *rows, *_left_out(len(shown) - len(rows)), ""]
    rows = _rows(folded, room - _size(rows))
    if folded:
        title = f"{len(folded)} {'other ' if shown else ''}{plural('cell', len(folded))}"
        left_out = _left_out(len(folded) - len(rows))
        lines += ["<details>", f"<summary>{title}</summary>", "", *_HEAD, *rows, *left_out, "", "</details>", ""]
    return "\n".join(lines)


_HEAD = ("| verdict | scene | renderer | why |", "|---|---|---|---|")


def _rows(cells: Sequence[Cell], room: int) -> list[str]:
    """As many rows of the table as there is room for, in bytes."""
    rows: list[str] = []
    for cell in cells:
        row = _row(cell)
        room -= _size([row])
        if room < 0:
            break
        rows.append(row)
    return rows


def _row(cell: Cell) -> str:
    """A line of the table: the reason with the worst pixel, each on a line of its own."""
    wording = WORDINGS[outcome(cell)]
    why = [escaped(line) for line in [cell.reason, *evidence(cell)]]
    if cell.waived is not None:
        why.append(f"waived: {escaped(cell.waived.reason)} {escaped(cell.waived.link)}")
    columns = (f"{cell.renderer}/{cell.integrator}", cell.scene)
    renderer, scene = map(escaped, columns)
    return f"| {wording.sign} {wording.word} | {scene} | {renderer} | {'<br>'.join(why)} |"


def _left_out(count: int) -> list[str]:
    return [f"\n{count} more {plural('cell', count)} had no room here: see the report."] if count else []


def _size(lines: Sequence[str]) -> int:
    """In bytes, with the ends of the lines."""
    return sum(len(line.encode()) + 1 for line in lines)


def escaped(text: str) -> str:
    """The text on one line, as Markdown that shows it letter by letter."""
    return _MARKUP.sub(r"\\\g<0>", printable(" ".join(text.split())))
