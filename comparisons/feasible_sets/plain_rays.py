"""What the compiled evaluator asks of plain balls: a number is all that is known of it (PlainRays in rounded_rays.py).

In the compiler's language. To the type checker a number is of any type: the source says `float` for it.
"""

from __future__ import annotations

from typing import Any

from raytruth.comparisons.feasible_sets.tree_memory import IS_FULL, MOST_NODES, RAYS
from raytruth.reference_tracer.arithmetics.scripted_decisions import COMPARISONS
from raytruth.reference_tracer.compiler.questions import state


def known_number(ball: Any) -> Any:
    """A number of which a ball is known."""
    return ball


def box_of(number: Any) -> Any:
    """The ball that holds it."""
    return number


def keep_ray(origin: Any, direction: Any) -> int:
    """Keep a ray behind the others; gives its place."""
    counts, rays = state().tree.counts, state().rays
    place: int = counts[RAYS]
    if place >= MOST_NODES:
        counts[IS_FULL] = 1
        return 0
    for axis in range(3):
        rays[place, axis] = origin[axis]
        rays[place, axis + 3] = direction[axis]
    counts[RAYS] = place + 1
    return place


def kept_ray(place: int) -> Any:
    """Its origin and direction."""
    rays = state().rays
    return (rays[place, 0], rays[place, 1], rays[place, 2]), (rays[place, 3], rays[place, 4], rays[place, 5])


def rays_kept() -> int:
    """How many there are."""
    kept: int = state().tree.counts[RAYS]
    return kept


def forget_rays(first: int) -> None:
    """Forget all from this place on."""
    state().tree.counts[RAYS] = first


def work_done() -> int:
    """Comparisons, of which a bundle's way through boxes, triangles and spheres is made."""
    done: int = state().decisions.counts[COMPARISONS]
    return done
