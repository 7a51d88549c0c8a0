"""The kill matrix as shown: on a terminal, as an HTML page, and as the table of docs/kill-matrix.md."""

from __future__ import annotations

from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined
from rich.text import Text

from raytruth.comparisons.records.kill_results import read_kill_results
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports import wording

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from rich.console import Console

    from raytruth.comparisons.records.kill_results import FaultResult, KillResults, SubjectResult

PAGE_FILE = "faults.html"
SHADES = 5
"""The number of shades of the heat map, each 100 times further from passing than the one before."""

LARGEST_TOLD = 1e9
"""A margin beyond this is no more telling: where black is due the tolerance is next to nothing."""


def summary(results: KillResults) -> str:
    """The kill matrix in one sentence: how many faults are found, how many right variants flagged."""
    killed = sum(fault.killed for fault in results.faults)
    flagged = len(results.false_alarms)
    return (
        f"{killed} of {len(results.faults)} faults are killed by {len(results.scenes)} scenes; "
        f"{flagged} of {len(results.variants)} legitimate variants are flagged."
    )


def gate_counts(results: KillResults) -> list[tuple[str, int, int]]:
    """For each way of judging, ours first, how many faults it finds and how many legitimate variants it flags."""
    ours = sum(fault.killed for fault in results.faults), len(results.false_alarms)
    return [
        ("raytruth: every pixel in its feasible set", *ours),
        *((gate, _rejected(results.faults, gate), _rejected(results.variants, gate)) for gate in results.gates),
    ]


def _rejected(subjects: Sequence[SubjectResult], gate: str) -> int:
    return sum(gate in subject.gates for subject in subjects)


def print_kills(results: KillResults, console: Console, page: Path | None = None) -> None:
    """A line for each fault (how far it is from passing, on how many scenes, its clause), and what it comes to."""
    for fault in results.faults:
        judged = f"{len(fault.killed_by)} of {len(fault.margins)} scenes"
        _line(console, f"{_state(fault):<9} {fault.clause:<7} {fault.name}: {judged}, margin {margin(fault.margin)}")
    for variant in results.variants:
        if variant.flagged:
            _line(console, f"flagged   variant {variant.name}: on {', '.join(variant.failed_on)}")
    for judge, faults, variants in gate_counts(results):
        _line(console, f"{judge}: kills {faults} of {len(results.faults)}, flags {variants} of {len(results.variants)}")
    _line(console, f"Quick suite, {quick_seconds(results):.3g} s a renderer: {' '.join(results.quick)}")
    _line(console, summary(results))
    if page is not None:
        _line(console, f"Page: {page}")


def _line(console: Console, text: str) -> None:
    """Never wrapped, so that it can be searched and copied."""
    console.print(Text(wording.printable(text)), soft_wrap=True)


def _state(fault: FaultResult) -> str:
    return "killed" if fault.killed else "SURVIVES"


def margin(value: float | None) -> str:
    """A margin in tolerances as a text of two digits; ∞ for None."""
    if value is None:
        return "∞"
    return f"{value:.2g}" if value <= LARGEST_TOLD else f">{LARGEST_TOLD:.0e}".replace("e+0", "e")


def quick_seconds(results: KillResults) -> float:
    """How many seconds of processor time the quick suite takes for one renderer."""
    return sum(results.scenes[name] for name in results.quick)


def shade(value: float | None) -> int:
    """The place of a margin on the heat map: 0 for a pass, else 1 to SHADES."""
    if value is None:
        return SHADES
    step, limit = 0, 1.0
    while value > limit and step < SHADES:
        step, limit = step + 1, limit * 100.0
    return step


def clauses_by_scene(directory: Path) -> dict[str, tuple[str, ...]]:
    """The clauses of the specification of which each scene finds a fault, as the kill matrix beside the results says.

    {} where there is none, or it is damaged: then its own command tells.
    """
    try:
        faults = read_kill_results(directory).faults
    except (OSError, ValueError):
        return {}
    clauses: dict[str, set[str]] = {}
    for fault in faults:
        for scene in fault.killed_by:
            clauses.setdefault(scene, set()).add(fault.clause)
    return {scene: tuple(sorted(found)) for scene, found in clauses.items()}


def write_kill_report(directory: Path) -> Path:
    """Write `faults.html` into a results directory that has `faults.json`, whole or not at all; returns its path."""
    results = read_kill_results(directory)
    loader = PackageLoader("raytruth.reports")
    environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=lambda value: wording.printable(value) if type(value) is str else value,
    )
    environment.filters["margin"] = margin
    environment.filters["shade"] = shade
    text = environment.get_template("kills.html.jinja").render(
        results=results,
        summary=summary(results),
        gates=gate_counts(results),
        quick_seconds=quick_seconds(results),
        style=loader.get_source(environment, "report.css")[0],
    )
    path = directory / PAGE_FILE
    write_whole(path, text)
    return path
