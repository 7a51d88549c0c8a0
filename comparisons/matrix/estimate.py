"""About how long the work of a run takes: from what has to be made, and from how long it took here before.

The constants are seconds of one processor of a small virtual machine, and only as good as that: they order the work and
give the first estimate on a machine. What was measured there, which `Pace` keeps in the cache, corrects them all by one
factor.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.kept_feasible_sets import has_feasible_set
from raytruth.reference_tracer.storage.cache import cache_folder, keep
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from raytruth.comparisons.matrix.plan import PlannedCell
    from raytruth.scenes.scene import Scene

# Measured over the library: a renderer's process with its libraries, an image without random numbers, and its test take
# from 0.1 s (POV-Ray) over 0.5 s (Mitsuba) to 1.3 s (VTK); random samples from 3 s (ptracer) to 9 s (Cycles).
RENDERING = 0.6
RANDOM_SAMPLES = 5.0
# Of a scene whose kernel is not compiled yet, as in most of a first run.
COMPILING = 3.0
# Of a pixel and each ray after the camera's that it may need, at most as many as the scene's depth.
TRUTH = 1.0e-4
# Behind glass rays become two at each surface, and rounding needs linked balls.
FEASIBLE_SET = 1.0e-4
FEASIBLE_SET_BEHIND_GLASS = 4.0e-4
# How many seconds of estimated work the measurement goes back: those of a first run of the library, which is most work.
REMEMBERED = 1500.0


def truth_seconds(cells: Sequence[PlannedCell]) -> float:
    """For the truth of a scene, which all its cells need; next to nothing where it is kept."""
    if all(_is_kept(cell) for cell in cells):
        return 0.0
    scene = cells[0].place.scene
    return COMPILING + TRUTH * _rays(scene)


def cells_seconds(cells: Sequence[PlannedCell]) -> float:
    """For cells of one scene and error model: their feasible set, unless it is kept, renderings and tests."""
    scene = cells[0].place.scene
    a_ray = FEASIBLE_SET_BEHIND_GLASS if _has_glass(scene) else FEASIBLE_SET
    making = 0.0 if all(_is_kept(cell) for cell in cells) else a_ray * _rays(scene)
    return making + sum(_rendering_seconds(cell) for cell in cells)


def _rendering_seconds(cell: PlannedCell) -> float:
    place = cell.place
    return RANDOM_SAMPLES if place.renderer.is_stochastic(place.scene, place.integrator.name) else RENDERING


def _rays(scene: Scene) -> int:
    return scene.camera.width * scene.camera.height * (1 + scene.max_depth)


def _has_glass(scene: Scene) -> bool:
    return any(material.dielectric is not None for material in used_materials(scene))


def _is_kept(cell: PlannedCell) -> bool:
    """Whether the feasible set of the cell is kept, and with it the truth."""
    with_colors = cell.place.integrator.gives != "first hits"
    return has_feasible_set(cell.place.scene, cell.error_model, with_colors=with_colors)


@dataclass
class Pace:
    """How long work took beside what it was estimated to take, on this machine."""

    # As much as some scenes: what is measured of one of them does not overturn the estimate of all.
    estimated: float = 30.0
    measured: float = 30.0

    def note(self, estimated: float, measured: float) -> None:
        """Count in what was measured of work that is done, in seconds."""
        self.estimated += estimated
        self.measured += measured

    def seconds(self, estimated: float) -> float:
        """How long work takes that is estimated to take so long."""
        return estimated * self.measured / self.estimated

    def keep(self) -> None:
        """For the next runs; of what is long ago less and less counts, and of a short run little."""
        share = min(1.0, REMEMBERED / self.estimated)
        text = f"{self.estimated * share} {self.measured * share}\n"
        keep(_pace_file(), lambda file: file.write_text(text, encoding="utf-8"))


def kept_pace() -> Pace:
    """That of earlier runs, where there is one."""
    try:
        estimated, measured = map(float, _pace_file().read_text(encoding="utf-8").split())
    except (OSError, ValueError):
        return Pace()
    is_usable = 0 < estimated < float("inf") and 0 < measured < float("inf")
    return Pace(estimated, measured) if is_usable else Pace()


def _pace_file() -> Path:
    return cache_folder() / "pace" / "run.txt"
