"""Faults in the attenuation of point lights (docs/spec.md, ILL-7)."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.features import INVERSE_SQUARE_FALLOFF, POLYNOMIAL_FALLOFF
from raytruth.reference_tracer.source.illumination import INVERSE_SQUARE, POLYNOMIAL
from raytruth.reference_tracer.source.scene_data import LIGHT_FALLOFF, LIGHT_FALLOFF_COEFFICIENTS, integer_of, vector_of

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


@fault("ILL-7", "attenuation", "What is the value of your formula at the distance 0, and what should it be?")
def falloff_softened(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """1/(1 + d²) is used in place of 1/d², against division by zero."""
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            divisor = constant + linear * sqrt(distance_squared) + quadratic * distance_squared
            if divisor > 1.0:
                return 1.0 / divisor
            return 1.0
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return 1.0 / (1.0 + distance_squared)
    return 1.0


@fault("ILL-7", "attenuation", "How bright may it be close to a light?")
def inverse_square_clamped(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """1/d² is clamped to 1, as only the polynomial is."""
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            divisor = constant + linear * sqrt(distance_squared) + quadratic * distance_squared
            if divisor > 1.0:
                return 1.0 / divisor
            return 1.0
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return min(1.0, 1.0 / distance_squared)
    return 1.0


@fault("ILL-7", "attenuation", "May attenuation make light brighter?")
def polynomial_not_clamped(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """1/(a + b·d + c·d²) is not clamped to 1, so light is amplified close to it."""
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return 1.0 / distance_squared
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            return 1.0 / (constant + linear * sqrt(distance_squared) + quadratic * distance_squared)
    return 1.0


@fault("ILL-7", "attenuation", "Which coefficient belongs to which power of the distance?")
def polynomial_reversed(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """The coefficients of 1/(a + b·d + c·d²) are read in reverse order."""
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return 1.0 / distance_squared
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            quadratic, linear, constant = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            divisor = constant + linear * sqrt(distance_squared) + quadratic * distance_squared
            if divisor > 1.0:
                return 1.0 / divisor
    return 1.0


@fault("ILL-7", "attenuation", "Where is the square root?")
def polynomial_of_the_squared_distance(scene: SceneData, light: int, distance_squared: Scalar) -> Scalar:
    """The linear coefficient is multiplied by the squared distance, whose root was forgotten."""
    if INVERSE_SQUARE_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == INVERSE_SQUARE:
            return 1.0 / distance_squared
    if POLYNOMIAL_FALLOFF:
        if integer_of(scene, LIGHT_FALLOFF, light) == POLYNOMIAL:
            constant, linear, quadratic = vector_of(scene, LIGHT_FALLOFF_COEFFICIENTS, light)
            divisor = constant + linear * distance_squared + quadratic * distance_squared
            if divisor > 1.0:
                return 1.0 / divisor
    return 1.0
