"""`raytruth run`."""

from __future__ import annotations

import os
import shlex
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from rich.console import Console

from raytruth.comparisons.matrix.drawn_scenes import write_drawn_scenes
from raytruth.comparisons.matrix.earlier_results import damage_of
from raytruth.comparisons.matrix.plan import Plan, plan_run
from raytruth.comparisons.matrix.quick_suite import write_quick_suite
from raytruth.comparisons.matrix.results_directory import only_run_in, with_metrics, write_results
from raytruth.comparisons.matrix.waivers import WaiverError, apply_waivers, load_waivers
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.catalogue import UnknownRendererError, select_renderers, unusable_adapters
from raytruth.comparisons.renderers.protocol import why_unavailable
from raytruth.errors import UsageError
from raytruth.options import AsJson, expect_folder, open_scenes
from raytruth.output import progress, tell
from raytruth.programs import programs_of
from raytruth.reports.console import print_matrix
from raytruth.reports.wording import printable
from raytruth.run_progress import change, intention, judged, shown_as_they_come
from raytruth.scenes.library import library_names
from raytruth.written_report import report_files, written_report

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from raytruth.comparisons.matrix.waivers import Waiver
    from raytruth.comparisons.records.results import Cell, Results
    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene

FAILED = 1


def run(
    *scenes: str,
    renderer: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    renderer_command: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    renderer_file: Annotated[tuple[Path, ...], Parameter(negative="")] = (),
    require: Annotated[tuple[str, ...], Parameter(negative="")] = (),
    out: Path = Path("results"),
    jobs: int | None = None,
    waivers: Path | None = None,
    fresh: Annotated[bool, Parameter(negative="")] = False,
    strict: Annotated[bool, Parameter(negative="")] = False,
    quick: Annotated[bool, Parameter(negative="")] = False,
    families: int | None = None,
    seed: int | None = None,
    junit: Path | None = None,
    summary: Path | None = None,
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
    renderer_command
        A program of your own, as in `--renderer-command 'mine=./tracer {scene} {output}'`: it reads the scene's JSON
        file and writes an OpenEXR picture, or another as in {output}.pfm. May be given several times.
    renderer_file
        A program of your own as a TOML file declares it, which `raytruth renderers --init NAME` writes to start from.
        Where programs are given and no --renderer, only they run.
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
    families
        So many scenes drawn over all that the scene format can say, with small images, instead of the library.
    seed
        What draws them: the same seed draws the same scenes; 0 by default.
    junit
        Write the verdicts in the results directory to this file, too, as JUnit XML: a test for each cell.
    summary
        Write a summary of it to this file, too, in Markdown, as GitHub shows it of a job:
        `--summary "$GITHUB_STEP_SUMMARY"`.
    as_json
        Print the results as one JSON document instead of the table.
    """
    processes = _processes(jobs)
    expect_folder(out)
    files = report_files(junit, summary)
    programs = programs_of(renderer_command, renderer_file)
    selected, required = _chosen(renderer, require, programs)
    known_failures = _waivers(waivers, programs)
    opened = open_scenes(_chosen_scenes(scenes, out, quick=quick, families=families, seed=seed))
    with only_run_in(out):
        _tell_damage(out)
        plan = _planned(opened, selected, out, processes, fresh=fresh)
        write = partial(_written, out, opened, selected, plan, known_failures)
        try:
            cells = _judged_and_measured(plan, out, processes, write)
        except KeyboardInterrupt:
            write(_finished(opened, selected, out))
            raise
        results, cells, unmatched = write(cells)
        report = written_report(out, unless_current=True)
        files.write(out, strict=strict)
    _show(results, report, as_json)
    return _status(cells, _missing(required, plan), unmatched, strict=strict)


def _finished(opened: Mapping[str, Scene], selected: Mapping[str, Renderer], out: Path) -> list[Cell]:
    """The cells of a run that is broken off: they can be shown, and the next run goes on from there."""
    return list(plan_run(opened, list(selected.values()), out, fresh=False).settled)


def _processes(jobs: int | None) -> int:
    """How many work side by side. Raises UsageError for none."""
    if jobs is not None and jobs < 1:
        raise UsageError(f"--jobs: expected 1 or more, found {jobs}.")
    return jobs or os.cpu_count() or 1


def _planned(
    opened: Mapping[str, Scene], selected: Mapping[str, Renderer], out: Path, jobs: int, *, fresh: bool
) -> Plan:
    """What the run has to do, told before the renderers are tried, and again where that changes it."""
    foreseen: list[Plan] = []

    def announce(plan: Plan) -> None:
        foreseen.append(plan)
        tell(f"raytruth: {intention(plan, len(opened), len(selected), jobs)}")

    with progress("Looking for the renderers"):
        plan = plan_run(opened, list(selected.values()), out, fresh=fresh, tell=announce)
    sentence = change(foreseen[0], plan, jobs)
    if sentence is not None:
        tell(f"raytruth: {sentence}")
    return plan


def _judged_and_measured(plan: Plan, out: Path, jobs: int, write: Callable[[Sequence[Cell]], object]) -> list[Cell]:
    """All cells of the plan, those that are settled too; what there is is written and shown while the run goes on."""

    def show(cells: Sequence[Cell]) -> None:
        write(cells)
        written_report(out)

    cells = shown_as_they_come(plan.settled, judged(plan, out, jobs), show)
    with progress("Measuring global differences"):
        return with_metrics(out, cells)


def _written(
    out: Path,
    opened: Mapping[str, Scene],
    selected: Mapping[str, Renderer],
    plan: Plan,
    known_failures: Sequence[Waiver],
    cells: Sequence[Cell],
) -> tuple[Results, list[Cell], list[str]]:
    """The results as they are written, this run's cells as they are waived, and what is told of unmatched waivers."""
    waived, unmatched = apply_waivers(known_failures, cells, plan.versions, opened.values())
    with_versions = [(renderer, plan.versions[name]) for name, renderer in selected.items()]
    results = write_results(out, _command(), list(opened.values()), with_versions, waived)
    return results, waived, unmatched


def _chosen_scenes(
    scenes: Sequence[str], out: Path, *, quick: bool, families: int | None, seed: int | None
) -> Sequence[str]:
    """What names the scenes to run. Raises UsageError for ways of naming them that exclude one another."""
    if quick and scenes:
        raise UsageError("--quick: expected no scenes beside it, since it names the quick suite's own.")
    if families is None:
        if seed is not None:
            raise UsageError("--seed: expected --families beside it, which says how many scenes to draw.")
        return write_quick_suite(out) if quick else scenes or library_names()
    if quick or scenes:
        raise UsageError("--families: expected neither scenes nor --quick beside it, since it draws the scenes itself.")
    if families < 1:
        raise UsageError(f"--families: expected 1 scene or more, found {families}.")
    return write_drawn_scenes(out, families, seed or 0)


def _tell_damage(out: Path) -> None:
    """Say what of an earlier run's results cannot be read, if anything."""
    damage = damage_of(out)
    if damage is not None:
        tell(f"raytruth: {damage}")


def _chosen(
    renderer: Sequence[str], require: Sequence[str], programs: Mapping[str, Renderer]
) -> tuple[dict[str, Renderer], dict[str, Renderer]]:
    """The renderers to run, and those of them that must be available."""
    for sentence in unusable_adapters():
        tell(f"raytruth: {sentence}")
    # Who names a program wants it judged: one that cannot run is no success.
    required = {**programs, **(_selected("--require", require) if require else {})}
    return (_selected("--renderer", renderer) if renderer or not programs else {}) | required, required


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


def _waivers(path: Path | None, programs: Mapping[str, Renderer]) -> tuple[Waiver, ...]:
    """The waivers that raytruth knows itself, and those in the file."""
    try:
        return load_waivers() + (load_waivers(path, programs.values()) if path is not None else ())
    except WaiverError as error:
        raise UsageError(str(error)) from error


def _split(option: str, names: Sequence[str]) -> list[str]:
    """What stands between commas. Raises UsageError where an option is given and names nothing."""
    parts = [part.strip() for name in names for part in name.split(",") if part.strip()]
    if names and not parts:
        raise UsageError(f"{option}: expected the name of a renderer, found none; see raytruth renderers.")
    return parts


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
