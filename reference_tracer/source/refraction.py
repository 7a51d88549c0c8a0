"""Refraction by Snell's law (docs/spec.md, REFR).

η is the index of the medium that the ray goes into over that of the medium it comes from, c = -d·n the cosine of the
angle of incidence, and g² = η² - 1 + c². Since sin θi = η·sin θt, g = η·cos θt; total internal reflection iff g² < 0.
"""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING

from raytruth.reference_tracer.source.vector import along, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def snell_discriminant(cosine: Scalar, ratio: Scalar) -> Scalar:
    """The square of g = η·cos θt, which is negative for total reflection; without cancellation for nearly equal η."""
    return (ratio - 1.0) * (ratio + 1.0) + cosine * cosine


def refracted_direction(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """(d + (c - g)·n)/η: a unit vector if d and n are (Heckbert, "Derivation of Refraction Formulas", 1989)."""
    return scale(along(direction, normal, cosine - g), 1.0 / ratio)


def fresnel_reflectance(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The reflected fraction of unpolarised light, in [0, 1]; 1 at grazing incidence.

    R = r_s²/2·(1 + (r_p/r_s)²) with r_p/r_s = (c·g - s²)/(c·g + s²) and s² = 1 - c² (Cook, Torrance, "A Reflectance
    Model for Computer Graphics", 1982, section "The Fresnel Term"). The numerator of r_s = (c - g)/(c + g) is rewritten
    by g² - c² = η² - 1, so that nothing cancels where η is near 1; the quotient is in [-1, 1] however g is rounded. A
    cosine whose square underflows counts as grazing: for equal indices (g + c)² would underflow as well, and R be 0/0.
    """
    if cosine * cosine == 0.0:
        return 1.0
    perpendicular = (ratio - 1.0) * (ratio + 1.0) / ((g + cosine) * (g + cosine))
    sine_squared = (1.0 - cosine) * (1.0 + cosine)
    quotient = (cosine * g - sine_squared) / (cosine * g + sine_squared)
    return 0.5 * perpendicular * perpendicular * (1.0 + quotient * quotient)


def medium_transmittance(absorption: Vector, distance: Scalar) -> Vector:
    """The part exp(-σ·d) of light that a way d leaves (Bouguer, Lambert, Beer); σ in 1/length."""
    return (exp(-absorption[0] * distance), exp(-absorption[1] * distance), exp(-absorption[2] * distance))
