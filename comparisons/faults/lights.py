"""Faults in the sum over the lights (docs/spec.md, ILL-2, ILL-7 and ILL-8)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit


@fault(
    "ILL-2",
    "local_illumination",
    "Take all lights but one away: which one still counts?",
    Edit("range(rows_of(scene, LIGHT_POSITION))", "range(1)"),
    Edit("range(rows_of(scene, SUN_DIRECTION))", "range(1)"),
)
def first_light_only() -> None:
    """Only the first of all point lights is used, and only the first directional one."""


@fault(
    "ILL-2",
    "local_illumination",
    "What happens to the image if you list a light twice?",
    Edit("range(rows_of(scene, LIGHT_POSITION))", "range(-1, rows_of(scene, LIGHT_POSITION))"),
    Edit("light", "(light if light > 0 else 0)", times=3),
    Edit("range(rows_of(scene, SUN_DIRECTION))", "range(-1, rows_of(scene, SUN_DIRECTION))"),
    Edit("sun", "(sun if sun > 0 else 0)", times=2),
)
def first_light_counted_twice() -> None:
    """The sum begins with the first light and the loop adds it once more."""


@fault(
    "ILL-2",
    "local_illumination",
    "Should a room become darker when a dim lamp is switched on?",
    Edit(
        "attenuation(scene, light, dot(to_light, to_light))",
        "1.0 / float(rows_of(scene, LIGHT_POSITION)) * attenuation(scene, light, dot(to_light, to_light))",
    ),
)
def lights_averaged() -> None:
    """The light of all point lights is averaged instead of summed."""


@fault(
    "ILL-2",
    "local_illumination",
    "What colour has the light where a red and a blue lamp shine?",
    Edit("arriving", "(arriving[0], arriving[0], arriving[0])", times=2),
)
def lights_without_colour() -> None:
    """The red channel of a light's intensity is used for all three."""


@fault(
    "ILL-7",
    "local_illumination",
    "How far away is the sun?",
    Edit(
        "vector_of(scene, SUN_IRRADIANCE, sun)",
        "scale(vector_of(scene, SUN_IRRADIANCE, sun), 1.0 / (1.0 + dot(point, point)))",
    ),
)
def sun_falls_off() -> None:
    """Directional light falls off with the distance from the origin, as if a point light stood there."""


@fault(
    "ILL-2",
    "local_illumination",
    "Where does sunlight come from, and where does its direction point?",
    Edit("negate(vector_of(scene, SUN_DIRECTION, sun))", "vector_of(scene, SUN_DIRECTION, sun)"),
)
def sun_from_the_other_side() -> None:
    """The direction in which sunlight travels is taken for the direction to the sun."""


@fault(
    "ILL-8",
    "local_illumination",
    "Which is the largest value in your file, and which one should it be?",
    Edit("return total", "return (min(total[0], 1.0), min(total[1], 1.0), min(total[2], 1.0))"),
)
def shading_clamped_to_one() -> None:
    """The sum of the local terms is clamped to 1 at each hit."""


@fault(
    "ILL-4",
    "local_illumination",
    "What does a lamp look like from the side?",
    Edit("emission(scene, material, point)", "scale(emission(scene, material, point), -dot(normal, direction))"),
)
def emission_falls_with_the_angle() -> None:
    """Emission is multiplied by the cosine of the viewing angle."""
