"""Runs of the matrix with the renderer that a test tells what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.plan import Plan, plan_run
from raytruth.comparisons.matrix.run import run_plan
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell
    from raytruth.scenes.scene import Scene
    from tests.comparisons.matrix.pretending import Pretender


def opened(sources: list[str]) -> dict[str, Scene]:
    """The scenes, by what names each on the command line."""
    return {source: open_scene(source) for source in sources}


def plan(renderer: Pretender, sources: list[str], out: Path, *, fresh: bool = False) -> Plan:
    """The plan of a run of this renderer alone."""
    return plan_run(opened(sources), [renderer], out, fresh=fresh)


def ran(renderer: Pretender, sources: list[str], out: Path, *, fresh: bool = False) -> list[Cell]:
    """The cells of a whole run."""
    planned = plan(renderer, sources, out, fresh=fresh)
    return [*planned.settled, *run_plan(planned, out, jobs=1)]


def forget_version(folder: Path) -> None:
    """As when what a trial depends on has changed."""
    (folder / "cache" / "versions" / "pretender.txt").unlink()
