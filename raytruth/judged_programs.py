"""Programs of a user on scenes, one cell after the other: what the plugin for pytest runs, without pytest."""

from __future__ import annotations

import shlex
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.matrix.plan import PlannedCell, plan_run
from raytruth.comparisons.matrix.results_directory import cell_place, with_metrics, write_results
from raytruth.comparisons.matrix.run import make_truth, run_cells
from raytruth.comparisons.matrix.waivers import apply_waivers
from raytruth.comparisons.matrix.whole_cells import whole_cell
from raytruth.reports.wording import printable
from raytruth.written_report import written_report

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping

    from raytruth.comparisons.matrix.plan import Plan
    from raytruth.comparisons.matrix.waivers import Waiver
    from raytruth.comparisons.records.results import Cell
    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene

Place = tuple[str, str, str]
"""Scene, renderer and integrator."""


@dataclass
class JudgedPrograms:
    """Programs, the scenes that they are judged on, and where the results lie."""

    programs: Mapping[str, Renderer]
    scenes: Mapping[str, Scene]
    """Each by what names it on the command line."""
    waivers: tuple[Waiver, ...]
    out: Path

    @property
    def places(self) -> Iterator[Place]:
        """All cells that there are."""
        for renderer in self.programs.values():
            for integrator in renderer.integrators:
                for scene in self.scenes.values():
                    yield scene.name, renderer.name, integrator.name

    def judged(self, place: Place) -> tuple[Cell, list[str]]:
        """The cell, rendered and judged unless nothing has changed, and a sentence for a waiver that matches nothing.

        Raises OSError or ImageError where the results cannot be written.
        """
        step = self._steps[place]
        if isinstance(step, PlannedCell):
            make_truth(step.place.scene, self.out)
            (step,) = run_cells([step], self.out)
        (cell,), unmatched = apply_waivers(self.waivers, [step], self._plan.versions, self.scenes.values())
        return cell, unmatched

    @cached_property
    def _plan(self) -> Plan:
        """Made where the first cell needs it, and then for all scenes: it asks each program for its version."""
        return plan_run(self.scenes, list(self.programs.values()), self.out, fresh=False)

    @cached_property
    def _steps(self) -> dict[Place, Cell | PlannedCell]:
        """By its place each cell that is settled, or what is to be done for it."""
        settled: dict[Place, Cell | PlannedCell] = {cell_place(cell): cell for cell in self._plan.settled}
        planned = (cell for cells in self._plan.by_scene.values() for cell in cells)
        return settled | {_place_of(cell): cell for cell in planned}

    def write_report(self, places: Collection[Place]) -> Path:
        """Write results.json and the report, where these cells have been judged, here or in other processes.

        Raises OSError or UsageError where they cannot be written.
        """
        names = {scene for scene, _, _ in places}
        scenes = {source: scene for source, scene in self.scenes.items() if scene.name in names}
        plan = plan_run(scenes, list(self.programs.values()), self.out, fresh=False)
        cells = [cell for cell in (*plan.settled, *_errors(plan, self.out)) if cell_place(cell) in places]
        cells, _ = apply_waivers(self.waivers, with_metrics(self.out, cells), plan.versions, scenes.values())
        command = printable(shlex.join([Path(sys.argv[0]).name, *sys.argv[1:]]))
        renderers = [(renderer, plan.versions[name]) for name, renderer in self.programs.items()]
        write_results(self.out, command, list(scenes.values()), renderers, cells)
        return written_report(self.out, unless_current=True)


def _errors(plan: Plan, out: Path) -> Iterable[Cell]:
    """The cells that ended in an error, which a plan would try again."""
    for planned in (cell for cells in plan.by_scene.values() for cell in cells):
        cell = whole_cell(out, planned.place.folder)
        if cell is not None:
            yield cell


def _place_of(planned: PlannedCell) -> Place:
    place = planned.place
    return place.scene.name, place.renderer.name, place.integrator.name
