"""`raytruth faults`."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from raytruth.comparisons.kills.kill_run import kill_results, run_kills, write_kill_results
from raytruth.comparisons.matrix.quick_suite import write_quick_scenes
from raytruth.errors import UsageError
from raytruth.options import AsJson, expect_folder, open_scene
from raytruth.output import tell
from raytruth.reports.html import REPORT_FILE
from raytruth.reports.kills import print_kills, write_kill_report
from raytruth.scene_score_command import score_scene
from raytruth.scenes.library import library_names
from raytruth.written_report import written_report

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.kills.kill_matrix import SceneKills
    from raytruth.scenes.scene import Scene

FAILED = 1


def faults(
    *scenes: str,
    scene: str | None = None,
    leaderboard: Path | None = None,
    by: str | None = None,
    out: Path = Path("results"),
    jobs: int | None = None,
    fresh: Annotated[bool, Parameter(negative="")] = False,
    write_quick: Annotated[bool, Parameter(negative="")] = False,
    as_json: AsJson = False,
) -> int:
    """Run the kill matrix: every known fault must be found on some scene, and no legitimate variant on any.

    Exit status 0 if all faults are killed and no variant is flagged, else 1.

    Parameters
    ----------
    scenes
        Names of library scenes, or paths of scene files; the whole library by default.
    scene
        In place of all that: score this one scene by the faults that it finds and the pixels that it needs. Exit
        status 1 then if it flags a right variant.
    leaderboard
        With --scene: enter the score into this file, in which each name has its best scene.
    by
        With --leaderboard: whose scene it is; the scene's own name by default.
    out
        The results directory: `faults.json`, the page `faults.html`, and what a later run takes over.
    jobs
        How many scenes are worked on side by side; one a processor by default.
    fresh
        Judge every scene again.
    write_quick
        Make the smallest set of scenes that kills everything the suite of `raytruth run --quick`.
    as_json
        Print the results as one JSON document instead of the tables.
    """
    if jobs is not None and jobs < 1:
        raise UsageError(f"--jobs: expected 1 or more, found {jobs}.")
    expect_folder(out)
    if scene is not None:
        if scenes or write_quick:
            raise UsageError("--scene: expected no other scenes and no --write-quick beside it; leave them out.")
        return score_scene(scene, by, leaderboard, out, fresh=fresh, as_json=as_json)
    if leaderboard is not None or by is not None:
        raise UsageError("faults: expected --scene FILE beside --leaderboard and --by; add it.")
    opened = [open_scene(source) for source in scenes or library_names()]
    start = time.perf_counter()
    kills = _run(opened, out, jobs or os.cpu_count() or 1, fresh=fresh)
    results = kill_results(kills, time.perf_counter() - start)
    write_kill_results(out, results)
    page = write_kill_report(out)
    if (out / REPORT_FILE).exists():
        written_report(out, unless_current=True)  # which then leads to the page of the faults
    if write_quick:
        write_quick_scenes(results.quick)
    if as_json:
        print(results.model_dump_json(indent=2))
    else:
        print_kills(results, Console(), page)
    return FAILED if results.survivors or results.false_alarms else 0


def _run(scenes: Sequence[Scene], out: Path, jobs: int, *, fresh: bool) -> list[SceneKills]:
    """All scenes, saying how far it has come."""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    done: list[SceneKills] = []
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task("Judging faults and variants", total=len(scenes))
        for kills in run_kills(scenes, out, jobs, fresh=fresh):
            done.append(kills)
            bar.advance(task)
            if not console.is_terminal:
                failing = sum(cell.fails for cell in kills.cells)
                line = f"[{len(done)}/{len(scenes)}] {kills.scene}: {failing} of {len(kills.cells)} fail"
                tell(line)
    return done
