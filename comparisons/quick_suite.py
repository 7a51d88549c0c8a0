"""The quick suite: the scenes that kill every fault of the catalogue in the least time, at the kill matrix's size."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.kill_matrix import small
from scenes.exporters.json_scene import export_json
from scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

QUICK_FOLDER = "quick-suite"
QUICK_FILE = Path(__file__).with_name("quick_suite.json")


def quick_scenes() -> tuple[str, ...]:
    """The names of the scenes, as `raytruth faults --write-quick` found them."""
    return tuple(json.loads(QUICK_FILE.read_text(encoding="utf-8")))


def write_quick_scenes(names: Sequence[str]) -> None:
    """Make this the quick suite."""
    QUICK_FILE.write_text(json.dumps(list(names), indent=1) + "\n", encoding="utf-8")


def write_quick_suite(directory: Path) -> tuple[str, ...]:
    """The scenes of the quick suite with small images, as scene files below the directory; returns their paths."""
    folder = directory / QUICK_FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    return tuple(str(export_json(small(open_scene(name)), folder)) for name in quick_scenes())


def smallest_cover(killers: Sequence[set[str]], costs: Mapping[str, float]) -> tuple[str, ...]:
    """The cheapest scenes such that each fault is killed by one of them; `killers` are the scenes that kill a fault.

    Exact: a set cover is an integer program, which HiGHS solves (scipy.optimize.milp) in a fraction of a second.
    """
    from scipy.optimize import Bounds, LinearConstraint, milp  # noqa: PLC0415 - half a second, which `run` needs not

    if not killers:
        return ()
    names = sorted(costs)
    rows = np.array([[name in scenes for name in names] for scenes in killers], dtype=np.float64)
    solution = milp(
        [costs[name] for name in names],
        integrality=np.ones(len(names)),
        bounds=Bounds(0, 1),
        constraints=LinearConstraint(rows, lb=1),
    )
    assert solution.success, f"the set cover has a solution: {solution.message}"
    return tuple(name for name, taken in zip(names, solution.x, strict=True) if taken > 0.5)
