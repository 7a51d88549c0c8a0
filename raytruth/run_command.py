"""`raytruth run`."""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from raytruth.comparisons.matrix.earlier_results import damage_of
from raytruth.comparisons.matrix.plan import Plan, plan_run
from raytruth.comparisons.matrix.quick_suite import write_quick_suite
from raytruth.comparisons.matrix.results_directory import only_run_in, with_metrics, write_results
from raytruth.comparisons.matrix.run import run_plan
from raytruth.comparisons.matrix.waivers import WaiverError, apply_waivers, load_waivers
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.catalogue import UnknownRendererError, select_renderers
from raytruth.comparisons.renderers.protocol import why_unavailable
from raytruth.errors import UsageError
from raytruth.options import AsJson, expect_folder, open_scene
from raytruth.output import progress, tell
from raytruth.reports.console import print_matrix
from raytruth.reports.wording import printable
from raytruth.scenes.library import library_names
from raytruth.written_report import written_report

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from raytruth.comparisons.matrix.waivers import Waiver
    from raytruth.comparisons.records.results import Cell, Results
    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene

FAILED = 1


def run(
    *scenes: str,
    renderer: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    require: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    out: Path = Path("results"),
    jobs: int | None = None,
    waivers: Path | None = None,
    fresh: Annotated[bool, Parameter(negative="")] = False,
    strict: Annotated[bool, Parameter(negative="")] = False,
    quick: Annotated[bool, Parameter(negative="")] = False,
    as_json: AsJson = False,
) -> int:
    """Run the conformance matrix: scenes × renderers, each cell judged against the truth.

    Exit status 0 if all comparable cells pass, 1 if one fails unwaived or errs, a waiver matches nothing, or a required
    renderer is missing.

    Examples: `raytruth run`, `raytruth run whitted-1980 my-scene.json --renderer mitsuba --out results`

    Parameters
    ----------
    scenes
        Names of library scenes, or paths of scene files; the whole library by default.
    renderer
        Only this renderer; all by default. May be given several times, or several names with commas.
    require
        Renderers that must be available, on pain of exit status 1.
    out
        The results directory; an earlier run's cells are kept, and taken over where nothing has changed.
    jobs
        How many processes work side by side; one a processor by default.
    waivers
        A JSON file of known failures that do not make the run fail, besides those that raytruth knows itself.
    fresh
        Render and judge every cell again. What depends on no renderer, truth and feasible sets, is still taken over.
    strict
        A cell that is as declared, not as due, makes the run fail, too.
    quick
        Only the quick suite: few scenes with small images, which still find every fault of the catalogue
        (`raytruth faults`).
    as_json
        Print the results as one JSON document instead of the table.
    """
    if jobs is not None and jobs < 1:
        raise UsageError(f"--jobs: expected 1 or more, found {jobs}.")
    expect_folder(out)
    required = _selected("--require", require) if require else {}
    selected = _selected("--renderer", renderer) | required
    known_failures = _waivers(waivers)
    if quick and scenes:
        raise UsageError("--quick: expected no scenes beside it, since it names the quick suite's own.")
    opened = _opened(write_quick_suite(out) if quick else scenes or library_names())
    with only_run_in(out):
        _tell_damage(out)
        with progress("Looking for the renderers"):
            plan = plan_run(opened, list(selected.values()), out, fresh=fresh)
        try:
            cells = _run(plan, out, jobs or os.cpu_count() or 1)
            with progress("Measuring global differences"):
                cells = with_metrics(out, cells)
        except KeyboardInterrupt:
            # What is finished can be shown, and the next run goes on from there.
            finished = plan_run(opened, list(selected.values()), out, fresh=False).settled
            waived, _ = apply_waivers(known_failures, finished, plan.versions, opened.values())
            write_results(out, _command(), list(opened.values()), _with_versions(selected, plan), waived)
            raise
        cells, unmatched = apply_waivers(known_failures, cells, plan.versions, opened.values())
        results = write_results(out, _command(), list(opened.values()), _with_versions(selected, plan), cells)
        report = written_report(out, unless_current=True)
    _show(results, report, as_json)
    return _status(cells, _missing(required, plan), unmatched, strict=strict)


def _tell_damage(out: Path) -> None:
    """Say what of an earlier run's results cannot be read, if anything."""
    damage = damage_of(out)
    if damage is not None:
        tell(f"raytruth: {damage}")


def _selected(option: str, names: Sequence[str]) -> dict[str, Renderer]:
    """The renderers that an option names, several in one text with commas; all if the option is not given."""
    try:
        return select_renderers(_split(option, names))
    except UnknownRendererError as error:
        raise UsageError(str(error)) from error


def _missing(required: Mapping[str, Renderer], plan: Plan) -> dict[str, str]:
    """The required renderers that are not available, and why not."""
    reasons = {name: why_unavailable(renderer, plan.versions[name]) for name, renderer in required.items()}
    return {name: reason for name, reason in reasons.items() if reason is not None}


def _waivers(path: Path | None) -> tuple[Waiver, ...]:
    """The waivers that raytruth knows itself, and those in the file."""
    try:
        return load_waivers() + (load_waivers(path) if path is not None else ())
    except WaiverError as error:
        raise UsageError(str(error)) from error


def _with_versions(selected: Mapping[str, Renderer], plan: Plan) -> list[tuple[Renderer, str | None]]:
    return [(renderer, plan.versions[name]) for name, renderer in selected.items()]


def _split(option: str, names: Sequence[str]) -> list[str]:
    """What stands between commas. Raises UsageError where an option is given and names nothing."""
    parts = [part.strip() for name in names for part in name.split(",") if part.strip()]
    if names and not parts:
        raise UsageError(f"{option}: expected the name of a renderer, found none; see raytruth renderers.")
    return parts


def _opened(sources: Iterable[str]) -> dict[str, Scene]:
    """Each scene by what names it on the command line. Raises UsageError where two have the same name."""
    opened: dict[str, Scene] = {}
    for source in sources:
        scene = open_scene(source)
        if scene.name in {known.name for known in opened.values()}:
            raise UsageError(f"There are two scenes called {scene.name!r}: give each scene file a name of its own.")
        opened[source] = scene
    return opened


def _run(plan: Plan, out: Path, jobs: int) -> list[Cell]:
    """Render and judge what the plan leaves to do, saying how far it has come."""
    total = sum(len(cells) for cells in plan.by_scene.values())
    cells = list(plan.settled)
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task("Rendering and judging", total=total)
        for done, cell in enumerate(run_plan(plan, out, jobs), start=1):
            cells.append(cell)
            bar.advance(task)
            if not console.is_terminal:
                line = f"[{done}/{total}] {cell.scene} {cell.renderer} {cell.integrator}: {cell.verdict}"
                tell(line)
    return cells


def _command() -> str:
    """For the results, which are UTF-8: a name of other bytes is shown with marks."""
    return printable(shlex.join(["raytruth", *sys.argv[1:]]))


def _show(results: Results, report: Path, as_json: bool) -> None:
    if as_json:
        print(results.model_dump_json(indent=2))
    else:
        print_matrix(results, Console(), report)


def _status(cells: Sequence[Cell], missing: Mapping[str, str], unmatched: Sequence[str], *, strict: bool) -> int:
    for name, reason in missing.items():
        tell(f"raytruth: {name} is required and {reason}")
    for sentence in unmatched:
        tell(f"raytruth: {sentence}")
    bad_ones = {Verdict.FAIL, Verdict.ERROR} | ({Verdict.DECLARED} if strict else set())
    bad = any(cell.verdict in bad_ones and cell.waived is None for cell in cells)
    return FAILED if bad or missing or unmatched else 0
