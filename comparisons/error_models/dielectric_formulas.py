"""How most tracers compute refraction and how light is split, in place of the formulas of the truth.

They are equal in exact arithmetic, but lose more where indices are nearly equal and near the critical angle: those of
the specification as well, for who writes them as they stand there. The functions here are source of the tracer, as
those of triangle_tests.py. η is n_t/n_i, as in refraction.py; Heckbert's and Bec's are written in its inverse.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.source.vector import along, scale

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def dielectric_behaviour(error_model: ErrorModel) -> Behaviour:
    """What the renderer's formulas for dielectrics replace, nothing for the truth's own."""
    functions: dict[str, Function] = {}
    discriminants = {
        "as specified": specified_discriminant,
        "heckbert": heckbert_discriminant,
        "bec": bec_discriminant,
    }
    if error_model.refraction in discriminants:
        functions["snell_discriminant"] = discriminants[error_model.refraction]
    if error_model.refraction in {"heckbert", "bec"}:
        functions["refracted_direction"] = refracted_direction_by_inverse
    reflectances = {"as specified": specified_reflectance, "cosines": fresnel_by_cosines}
    if error_model.fresnel in reflectances:
        functions["fresnel_reflectance"] = reflectances[error_model.fresnel]
    return Behaviour(functions, name="the formulas for dielectrics")


def specified_discriminant(cosine: Scalar, ratio: Scalar) -> Scalar:
    """g² = η² - 1 + c² (docs/spec.md, REFR-2), from left to right."""
    return ratio * ratio - 1.0 + cosine * cosine


def heckbert_discriminant(cosine: Scalar, ratio: Scalar) -> Scalar:
    """(η·c₂)² with c₂² = 1 - (1 - c₁²)/η² (Heckbert, in Glassner (ed.), An Introduction to Ray Tracing, 1989)."""
    inverse = 1.0 / ratio
    return (1.0 - inverse * inverse * (1.0 - cosine * cosine)) * (ratio * ratio)


def bec_discriminant(cosine: Scalar, ratio: Scalar) -> Scalar:
    """(η·c₂)² with c₂² = 1 + (w - 1/η)(w + 1/η), w = c₁/η (Bec, "Faster Refraction Formula", Ray Tracing News 1997)."""
    inverse = 1.0 / ratio
    scaled = inverse * cosine
    return (1.0 + (scaled - inverse) * (scaled + inverse)) * (ratio * ratio)


def refracted_direction_by_inverse(
    direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar
) -> Vector:
    """d/η + (c₁/η - c₂)·n, as Heckbert and Bec have it."""
    inverse = 1.0 / ratio
    return along(scale(direction, inverse), normal, inverse * cosine - g / ratio)


def specified_reflectance(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """r_s = (c - g)/(c + g), r_p = (η²c - g)/(η²c + g) (docs/spec.md, REFR-4)."""
    if cosine + g == 0.0:
        return 1.0
    scaled = ratio * ratio * cosine
    across = (cosine - g) / (cosine + g)
    within = (scaled - g) / (scaled + g)
    return 0.5 * (across * across + within * within)


def fresnel_by_cosines(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:  # noqa: ARG001 - the signature of the function it stands for
    """r_s = (n₁c₁ - n₂c₂)/(n₁c₁ + n₂c₂), r_p = (n₂c₁ - n₁c₂)/(n₂c₁ + n₁c₂), with c₂ from the sine by Snell's law.

    Born, Wolf, Principles of Optics, 7th ed., 1.5.2; all divided by n₁. Many programs find c₂ here once more.
    """
    sine_beyond = sqrt(max(1.0 - cosine * cosine, 0.0)) / ratio
    beyond = sqrt(max(1.0 - sine_beyond * sine_beyond, 0.0))
    perpendicular = cosine + ratio * beyond
    parallel = ratio * cosine + beyond
    if perpendicular == 0.0 or parallel == 0.0:
        return 1.0
    across = (cosine - ratio * beyond) / perpendicular
    within = (ratio * cosine - beyond) / parallel
    return 0.5 * (across * across + within * within)
