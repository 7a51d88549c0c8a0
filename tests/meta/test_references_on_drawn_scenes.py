"""No right renderer fails on an ordinary scene: the references are right on scenes that nobody has chosen.

A reference that fails here is wrong on the scene, or its error model is: find out which, before you waive it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

from raytruth.comparisons.matrix.plan import plan_run
from raytruth.comparisons.matrix.run import run_plan
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.families.catalogue import FAMILIES, family

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.results import Cell

pytestmark = [pytest.mark.clause("VER-2", "REN-4"), pytest.mark.simulation]

SCALES = FAMILIES["drawn"].parameters
# Two dozen in each run of the tests, five hundred in the deep profile, which has ten thousand examples.
SEEDS = range(500 if settings.default.max_examples > 1000 else 24)
# Whose light paths forward from the lamps take longer than all else: on every third scene.
SLOW, EVERY = "mitsuba-llvm", 3


def judged(seed: int, folder: Path) -> list[Cell]:
    """All cells of the scene of a seed."""
    scene = family("drawn", SCALES[seed % len(SCALES)], seed).model_copy(update={"name": f"drawn-{seed}"})
    renderers = [r for name, r in all_renderers().items() if name != SLOW or seed % EVERY == 0]
    plan = plan_run({scene.name: scene}, renderers, folder, fresh=True)
    return [*plan.settled, *run_plan(plan, folder, 1)]


@pytest.mark.parametrize("seed", SEEDS)
def test_no_reference_fails_on_a_drawn_scene(seed: int, tmp_path: Path) -> None:
    cells = judged(seed, tmp_path)
    wrong = [
        f"{cell.renderer}/{cell.integrator}: {cell.reason}"
        for cell in cells
        if cell.verdict in {Verdict.FAIL, Verdict.ERROR}
    ]
    assert wrong == [], f'family("drawn", {SCALES[seed % len(SCALES)]}, {seed})'
    assert sum(cell.verdict in {Verdict.PASS, Verdict.DECLARED} for cell in cells) > 1
