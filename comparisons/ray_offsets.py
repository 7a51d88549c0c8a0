"""How a renderer with ray offsets leaves a surface, in place of the ideal way: overrides for ball arithmetic.

The ideal tracer starts on the surface and excludes the surface itself. A renderer that starts beside the surface does
so to the same end, so the surface stays excluded; what changes is where the ray starts, and how far the other side of
a sphere is from there.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import arb

from reference_tracer.balls import comparison_functions

if TYPE_CHECKING:
    from collections.abc import Callable

    from comparisons.error_model import ErrorModel
    from reference_tracer.balls import Decisions

Point = tuple[Any, Any, Any]


def offset_overrides(error_model: ErrorModel, decisions: Decisions) -> dict[str, Callable[..., Any]]:
    """The functions of the tracer's source that this renderer's offsets change."""
    overrides: dict[str, Callable[..., Any]] = {}
    if error_model.ray_offset > 0.0:
        overrides.update(_departures(error_model.ray_offset, decisions))
    if error_model.shadow_shortening > 0.0:
        end = arb(1.0 - error_model.shadow_shortening)
        overrides["shadow_ray_end"] = lambda: end
    return overrides


def _departures(relative_offset: float, decisions: Decisions) -> dict[str, Callable[..., Any]]:
    is_less = comparison_functions(decisions)["is_less"]

    def offset_at(point: Point) -> Any:
        largest = abs(point[0]).max(abs(point[1])).max(abs(point[2]))
        return (largest + 1) * relative_offset

    def departure(primitive: int, point: Point, normal: Point) -> tuple[Point, int]:
        offset = offset_at(point)
        x, y, z = (p + n * offset for p, n in zip(point, normal, strict=True))
        return (x, y, z), primitive

    def distance_to_other_side(origin: Point, direction: Point, center: Point) -> Any:
        """From a point that lies an offset δ inside the sphere, |o-c| = r - δ: the positive root of the quadratic.

        Its constant term |o-c|² - r² = -2|o-c|δ - δ² is taken from δ: as a difference it would be lost to rounding.
        δ is computed at the moved origin, whose coordinates differ from the point's by up to δ, so that what is found
        there is between 1 - ε and 1 + ε times δ, where ε is the relative offset.
        """
        from_center = [o - c for o, c in zip(origin, center, strict=True)]
        half_linear = sum((d * f for d, f in zip(direction, from_center, strict=True)), arb(0))
        if not is_less(half_linear, 0):
            return arb(math.inf)
        offset = offset_at(origin) / arb(1, relative_offset)
        squared = sum((d * d for d in direction), arb(0))
        from_center_length = sum((f * f for f in from_center), arb(0)).sqrt()
        product = (2 * from_center_length + offset) * offset
        return ((half_linear * half_linear + squared * product).sqrt() - half_linear) / squared

    return {"departure": departure, "distance_to_other_side": distance_to_other_side}
