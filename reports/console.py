"""The matrix on a terminal, and as plain lines anywhere else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.cells import cell_len
from rich.table import Table
from rich.text import Text

from raytruth.comparisons.records.results import Verdict
from raytruth.reports.confirmation import in_one_line
from raytruth.reports.wording import (
    WAIVED,
    WORDINGS,
    capped,
    cells_by_place,
    columns,
    number,
    outcome,
    outcome_counts,
    printable,
    summary,
)

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import Console

    from raytruth.comparisons.records.results import Cell, Results

STYLES: dict[str, str] = {
    Verdict.PASS: "green",
    Verdict.DECLARED: "blue",
    Verdict.FAIL: "bold red",
    WAIVED: "yellow",
    Verdict.INCOMPARABLE: "dim",
    Verdict.UNAVAILABLE: "dim",
    Verdict.ERROR: "bold magenta",
}


def print_matrix(results: Results, console: Console, report: Path | None = None) -> None:
    """Print the verdict of every cell, the reasons of those that fail or err, the counts, and where the report is.

    On a terminal a table of scenes by renderers/integrators; elsewhere one line a cell, made to be searched.
    """
    if console.is_terminal:
        _print_table(results, console)
        for cell in results.cells:
            if cell.verdict in {Verdict.DECLARED, Verdict.FAIL, Verdict.ERROR}:
                console.print(_trouble(cell, console))
    else:
        for cell in results.cells:
            _print_line(console, _plain(cell))
    _print_line(console, summary(results))
    capped_line = capped(results)
    if capped_line is not None:
        _print_line(console, capped_line)
    agreement_line = in_one_line(results)
    if agreement_line is not None:
        _print_line(console, agreement_line)
    if report is not None:
        _print_line(console, f"Report: {report}")


def _print_table(results: Results, console: Console) -> None:
    """Print the matrix, with the columns' names where they fit, else with numbers and a key."""
    names = [f"{renderer}/{integrator}" for renderer, integrator in columns(results)]
    stacked = [name.replace("/", "\n", 1) for name in names]
    widest_scene = max((cell_len(scene.name) for scene in results.scenes), default=0)
    fits = widest_scene + sum(1 + _widest_line(header) for header in stacked) <= console.width  # 1: the gap
    table = _table(results, console, stacked if fits else [str(i) for i in range(1, len(names) + 1)])
    console.print(table)
    if not fits:
        for i, name in enumerate(names, start=1):
            _print_line(console, f"{i:>3}  {name}")
    legend = Text("  ").join(
        Text(f"{_sign(known, console)} {WORDINGS[known].word}", style=STYLES[known])
        for known, count in outcome_counts(results).items()
        if count > 0
    )
    console.print(legend)


def _table(results: Results, console: Console, headers: list[str]) -> Table:
    table = Table(box=None, padding=(0, 1, 0, 0))
    table.add_column("Scene", overflow="fold")
    for header in headers:
        table.add_column(_text(header, console), justify="center", no_wrap=True, min_width=_widest_line(header))
    cells = cells_by_place(results)
    for scene in results.scenes:
        row = [cells.get((scene.name, *column)) for column in columns(results)]
        signs = [
            Text(" ") if cell is None else Text(_sign(outcome(cell), console), style=STYLES[outcome(cell)])
            for cell in row
        ]
        table.add_row(_text(scene.name, console), *signs)
    return table


def _trouble(cell: Cell, console: Console) -> Text:
    """Why a cell failed, in one paragraph."""
    place = f"{cell.scene} {cell.renderer}/{cell.integrator}"
    known = outcome(cell)
    return Text.assemble(
        (f"{_sign(known, console)} {WORDINGS[known].word}", STYLES[known]),
        _text(f" {place}: {_reason(cell)}", console),
    )


def _plain(cell: Cell) -> str:
    """One line of a cell: outcome, scene, renderer/integrator, largest error, reason."""
    error = "" if cell.largest_error is None else f" (largest error {number(cell.largest_error)})"
    place = f"{cell.scene} {cell.renderer}/{cell.integrator}"
    return f"{outcome(cell):<12} {place}{error}: {_reason(cell)}".replace("\n", " ")


def _reason(cell: Cell) -> str:
    if cell.waived is None:
        return cell.reason
    return f"{cell.reason}; waived: {cell.waived.reason} {cell.waived.link}"


def _print_line(console: Console, line: str) -> None:
    """A line that is never wrapped, so that it can be searched and copied."""
    console.print(_text(line, console), soft_wrap=True)


def _text(text: str, console: Console) -> Text:
    """Untrusted words: no markup, no terminal escapes, only characters that the output can encode."""
    return Text(printable(text).encode(console.encoding, "replace").decode(console.encoding))


def _sign(known: str, console: Console) -> str:
    """The outcome's sign, or its initial letter where the output cannot encode the sign."""
    sign = WORDINGS[known].sign
    encodable = sign.encode(console.encoding, "ignore") != b""
    return sign if encodable else WORDINGS[known].word[0].upper()


def _widest_line(header: str) -> int:
    return max(cell_len(line) for line in header.splitlines())
