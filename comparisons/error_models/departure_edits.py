"""What a renderer's departures change in the tracer's source: edits of it, as a fault's are, or other functions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.error_models.departures import NONE
from raytruth.comparisons.error_models.shading_points import (
    SHADING_POINT,
    clamped_diffuse,
    from_surface,
    lambert,
    shading_point_helper,
)
from raytruth.reference_tracer.arithmetics.balls import stored_number
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.edits import Edit, at_the_start, edited

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from raytruth.comparisons.error_models.departures import Departures
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

constant_reflectance: Scalar = 0.0
constant_transmittance: Scalar = 0.0
"""Constants of the behaviour that `split_by_constants` is part of."""


def departure_behaviour(error_model: ErrorModel) -> Behaviour:
    """What this renderer's departures change; its constants are balls that hold what the renderer stores.

    Raises ValueError for edits that cannot be made, which is a mistake here.
    """
    departures, bits = error_model.departures, error_model.precision_bits
    helpers = (
        shading_point_helper("lit_point", error_model, beside=departures.lit_from != "surface"),
        shading_point_helper("textured_point", error_model, beside=departures.textured_at != "surface"),
        from_surface,
        lambert,
        clamped_diffuse,
    )
    names = [helper.__name__ for helper in helpers]
    functions: dict[str, Function] = {
        name: edited(name, *edits, helpers=names) for name, edits in edits_of(departures).items() if edits
    }
    constants: dict[str, Any] = {}
    if departures.fresnel != "exact":
        incident = departures.fresnel == "schlick on the incident side"
        functions["fresnel_reflectance"] = schlick_by_incident_cosine if incident else schlick_by_thin_cosine
    if departures.constant_weights is not None:
        functions["split"] = split_by_constants
        reflected, transmitted = departures.constant_weights
        constants["constant_reflectance"] = stored_number(reflected, bits)
        constants["constant_transmittance"] = stored_number(transmitted, bits)
    return Behaviour(functions, helpers if departures != NONE else (), constants, "departures")


def edits_of(departures: Departures) -> Mapping[str, tuple[Edit, ...]]:
    """The edits of each function of the source; those of several departures are made one after the other."""
    return {
        "trace_ray": tuple(_edits_of_paths(departures)),
        "local_illumination": tuple(_edits_of_illumination(departures)),
        "direct_light": tuple(_edits_of_light(departures)),
    }


def _edits_of_paths(departures: Departures) -> Iterator[Edit]:
    """A ray that may not be traced any more is traced all the same, with a depth of -1, and sends none on."""
    if departures.end_of_depth == "black":
        return
    yield Edit("depth > 0", "depth >= 0")
    if departures.end_of_depth == "background":
        yield Edit(
            "distance, primitive = nearest_hit(scene, origin, direction, left)",
            """
            if depth < 0:
                return multiply(weight, background_radiance(scene, direction))
            distance, primitive = nearest_hit(scene, origin, direction, left)
            """,
        )


def _edits_of_illumination(departures: Departures) -> Iterator[Edit]:
    if departures.lit_from != "surface":
        light = "vector_of(scene, LIGHT_POSITION, light)"
        yield Edit(f"subtract({light}, point)", f"subtract({light}, {SHADING_POINT['lit']})")
    if departures.textured_at != "surface":
        yield Edit("emission(scene, material, point)", f"emission(scene, material, {SHADING_POINT['textured']})")
    if departures.clamped_lambert:
        yield Edit(
            "return total",
            """
            if DIFFUSE:
                total = add(total, clamped_diffuse(scene, primitive, material, point, normal))
            return total
            """,
        )


def _edits_of_light(departures: Departures) -> Iterator[Edit]:
    to_light = "to_light"
    if departures.lit_from != "surface":
        to_light = "from_surface(primitive, point, normal, to_light, light_is_near)"
    shadowed = f"is_shadowed(scene, primitive, point, normal, {to_light}, light_is_near)"
    if departures.lit_from != "surface":
        yield Edit("is_shadowed(scene, primitive, point, normal, to_light, light_is_near)", shadowed)
    if departures.textured_at != "surface":
        yield Edit("diffuse(scene, material, point)", f"diffuse(scene, material, {SHADING_POINT['textured']})")
    if departures.highlights != "lit":
        yield from _edits_of_highlights(departures, shadowed)
    if departures.clamped_lambert:
        yield Edit("DIFFUSE", "False")
        # Without highlights nothing is left that would need a shadow ray.
        yield at_the_start("""
            if PHONG or BLINN:
                pass
            else:
                return (0.0, 0.0, 0.0)
            """)


def _edits_of_highlights(departures: Departures, shadowed: str) -> Iterator[Edit]:
    """What hides the light takes away the diffuse term alone."""
    is_lit = f"not {shadowed}"
    if departures.highlights == "everywhere":
        is_lit = f"faces_light and not {shadowed}"
        yield Edit("if not faces_light:\n    return (0.0, 0.0, 0.0)", "")
    yield Edit(f"if {shadowed}:\n    return (0.0, 0.0, 0.0)", "")
    texture = SHADING_POINT["textured"] if departures.textured_at != "surface" else "point"
    diffuse = f"reflectance = add(reflectance, scale(diffuse(scene, material, {texture}), cosine))"
    yield Edit(diffuse, f"if {is_lit}:\n    {diffuse}")


def schlick_by_thin_cosine(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """R₀ + (1 - R₀)(1 - c)⁵, with R₀ = ((η - 1)/(η + 1))² and c the cosine on the side with the lower index.

    Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994. g = η·cos θt, as in refraction.py.
    """
    normal_incidence = ((ratio - 1.0) / (ratio + 1.0)) * ((ratio - 1.0) / (ratio + 1.0))
    thin = cosine
    if ratio < 1.0:
        thin = g / ratio
    rest = 1.0 - thin
    return normal_incidence + (1.0 - normal_incidence) * (rest * rest * rest * rest * rest)


def schlick_by_incident_cosine(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:  # noqa: ARG001 - the signature of the function it stands for
    """The same with the cosine of incidence on both sides."""
    normal_incidence = ((ratio - 1.0) / (ratio + 1.0)) * ((ratio - 1.0) / (ratio + 1.0))
    rest = 1.0 - cosine
    return normal_incidence + (1.0 - normal_incidence) * (rest * rest * rest * rest * rest)


def split_by_constants(
    scene: SceneData,  # noqa: ARG001 - the signature of the function it stands for
    material: int,  # noqa: ARG001 - as above
    cosine: Scalar,  # noqa: ARG001 - as above
    g: Scalar,  # noqa: ARG001 - as above
    ratio: Scalar,  # noqa: ARG001 - as above
) -> tuple[Vector, Vector]:
    """Constant weights of the reflected and the transmitted ray, for all dielectrics."""
    reflected = (constant_reflectance, constant_reflectance, constant_reflectance)
    return reflected, (constant_transmittance, constant_transmittance, constant_transmittance)
