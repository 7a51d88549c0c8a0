"""The cheapest scenes that kill every fault."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


def smallest_cover(killers: Sequence[set[str]], costs: Mapping[str, float]) -> tuple[str, ...]:
    """The cheapest scenes such that each fault is killed by one of them; `killers` are the scenes that kill a fault.

    Exact: a set cover is an integer program, which HiGHS solves (scipy.optimize.milp) in a fraction of a second.
    """
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
