"""Refraction by Snell's law (docs/spec.md, REFR).

η is the index of the medium that the ray goes into over that of the medium it comes from, c = -d·n the cosine of the
angle of incidence, and g² = η² - 1 + c². Since sin θi = η·sin θt, g = η·cos θt; total internal reflection iff g² < 0.
"""

from __future__ import annotations

from math import exp
from typing import TYPE_CHECKING

from reference_tracer.vector import along, scale

if TYPE_CHECKING:
    from reference_tracer.numbers import Scalar, Vector


def snell_discriminant(cosine: Scalar, ratio: Scalar) -> Scalar:
    """g², written without cancellation for indices that are nearly equal."""
    return (ratio - 1.0) * (ratio + 1.0) + cosine * cosine


def refracted_direction(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """(d + (c - g)·n)/η: a unit vector if d and n are (Heckbert, "Derivation of Refraction Formulas", 1989)."""
    return scale(along(direction, normal, cosine - g), 1.0 / ratio)


def fresnel_reflectance(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The reflected fraction of unpolarised light, in [0, 1]; 1 at grazing incidence.

    With r_s = (c - g)/(c + g) and r_p = (η²c - g)/(η²c + g) (Born, Wolf, Principles of Optics, 7th ed., section 1.5.2),
    both numerators rewritten by g² - c² = η² - 1 so that nothing cancels where η is near 1.
    """
    if cosine == 0.0:
        return 1.0
    squared = ratio * ratio
    excess = (ratio - 1.0) * (ratio + 1.0)
    perpendicular = excess / ((g + cosine) * (g + cosine))
    parallel = excess * (1.0 - cosine * cosine * (1.0 + squared)) / ((g + squared * cosine) * (g + squared * cosine))
    return 0.5 * (perpendicular * perpendicular + parallel * parallel)


def medium_transmittance(absorption: Vector, distance: Scalar) -> Vector:
    """exp(-σ·d), the law of Bouguer, Lambert and Beer; σ in 1/length."""
    return (exp(-absorption[0] * distance), exp(-absorption[1] * distance), exp(-absorption[2] * distance))
