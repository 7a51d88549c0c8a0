"""Forms of tests of rays against triangles, spheres and boxes that answer a court: the tracer's and the textbooks'.

They are source of the tracer, interpreted with NumPy's numbers, which round as compiled ones do.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.court.box_forms import BOX_FORMS
from raytruth.comparisons.court.questions import Answer
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, INTERPRETED_FLOAT32, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.arithmetics.textbook_forms import (
    cramer_triangle_distance,
    moeller_trumbore,
    perpendicular_sphere_distance,
    quadratic_sphere_distance,
)
from raytruth.scenes.features import Feature

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.court.questions import Question
    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.reference_tracer.arithmetics.kernel import Kernel

FEATURES = frozenset({Feature.SPHERES, Feature.TRIANGLES})


def all_forms() -> dict[str, Callable[[Question], Answer | None]]:
    """By the names that reports show; each answers a question, or gives None for a shape that it is not for."""
    triangle_forms = {
        "ours, float32": (INTERPRETED_FLOAT32, IDEAL),
        "ours, float64": (FLOAT, IDEAL),
        "Möller-Trumbore, float32": (
            INTERPRETED_FLOAT32,
            Behaviour({"triangle_distance": moeller_trumbore}, name="Möller-Trumbore"),
        ),
        "Cramer, float32": (
            INTERPRETED_FLOAT32,
            Behaviour({"triangle_distance": cramer_triangle_distance}, name="Cramer's rule"),
        ),
    }
    sphere_forms = {
        "quadratic, float32": Behaviour({"sphere_distance": quadratic_sphere_distance}, name="the quadratic formula"),
        "perpendicular, float32": Behaviour(
            {"sphere_distance": perpendicular_sphere_distance}, name="the perpendicular form"
        ),
    }
    forms: dict[str, Callable[[Question], Answer | None]] = {}
    for name, (arithmetic, behaviour) in triangle_forms.items():
        shapes = ("triangles", "sphere") if behaviour is IDEAL else ("triangles",)
        forms[name] = _asked(make_kernel(arithmetic, FEATURES, behaviour), arithmetic, shapes)
    for name, behaviour in sphere_forms.items():
        kernel = make_kernel(INTERPRETED_FLOAT32, FEATURES, behaviour)
        forms[name] = _asked(kernel, INTERPRETED_FLOAT32, ("sphere",))
    return forms | {name: _asked_of_box(form) for name, form in BOX_FORMS.items()}


def _asked(kernel: Kernel, arithmetic: Arithmetic, shapes: tuple[str, ...]) -> Callable[[Question], Answer | None]:
    def answer(question: Question) -> Answer | None:
        if question.shape not in shapes:
            return None
        with np.errstate(all="ignore"):  # an overflow or a NaN is part of the answer
            return _nearest(kernel, arithmetic, question)

    return answer


def _nearest(kernel: Any, arithmetic: Arithmetic, question: Question) -> Answer:
    """The least of all distances, tried one by one: no tree stands between the ray and the form."""

    def numbers(point: tuple[float, float, float]) -> tuple[Any, ...]:
        return tuple(arithmetic.number(part) for part in point)

    ray = (numbers(question.origin), numbers(question.direction))
    if question.sphere is not None:
        center, radius = question.sphere
        distances = [kernel.sphere_distance(*ray, numbers(center), arithmetic.number(radius))]
    else:
        distances = [kernel.triangle_distance(*ray, *map(numbers, corners)) for corners in question.triangles]
    nearest = min(range(len(distances)), key=lambda index: distances[index])
    if not distances[nearest] < inf:
        return Answer(hit=False)
    primitive = nearest if question.triangles else None
    return Answer(hit=True, distance=float(distances[nearest]), primitive=primitive)


def _asked_of_box(form: Callable[..., bool]) -> Callable[[Question], Answer | None]:
    def answer(question: Question) -> Answer | None:
        if question.box is None:
            return None
        points = (question.origin, question.direction, *question.box)
        with np.errstate(all="ignore"):  # 0·∞ is what is asked about
            return Answer(hit=form(*(tuple(map(np.float32, point)) for point in points)))

    return answer
