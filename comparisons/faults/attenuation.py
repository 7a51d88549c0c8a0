"""Faults in the attenuation of point lights (docs/spec.md, ILL-7)."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("ILL-7", "attenuation", "How much light arrives at twice the distance?")
def one_over_distance(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """Every light falls off with the distance, not with its square."""
    return 1.0 / sqrt(distance_squared)


@fault("ILL-7", "attenuation", "How much light arrives at twice the distance?")
def no_falloff(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """Light does not fall off at all, whatever the scene states."""
    return 1.0


@fault(
    "ILL-7",
    "attenuation",
    "What is the value of your formula at the distance 0, and what should it be?",
    Edit("1.0 / distance_squared", "1.0 / (1.0 + distance_squared)"),
)
def falloff_softened() -> None:
    """1/(1 + d²) is used in place of 1/d², against division by zero."""


@fault(
    "ILL-7",
    "attenuation",
    "How bright may it be close to a light?",
    Edit("1.0 / distance_squared", "min(1.0, 1.0 / distance_squared)"),
)
def inverse_square_clamped() -> None:
    """1/d² is clamped to 1, as only the polynomial is."""


@fault("ILL-7", "attenuation", "May attenuation make light brighter?", Edit("divisor > 1.0", "True"))
def polynomial_not_clamped() -> None:
    """1/(a + b·d + c·d²) is not clamped to 1, so light is amplified close to it."""


@fault(
    "ILL-7",
    "attenuation",
    "Which coefficient belongs to which power of the distance?",
    Edit(
        "constant + linear * sqrt(distance_squared) + quadratic * distance_squared",
        "quadratic + linear * sqrt(distance_squared) + constant * distance_squared",
    ),
)
def polynomial_reversed() -> None:
    """The coefficients of 1/(a + b·d + c·d²) are read in reverse order."""


@fault(
    "ILL-7",
    "attenuation",
    "Which power of the distance does the linear coefficient multiply in your program?",
    Edit("sqrt(distance_squared)", "distance_squared"),
)
def polynomial_of_the_squared_distance() -> None:
    """The linear coefficient is multiplied by the squared distance, whose root was forgotten."""
