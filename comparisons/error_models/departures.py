"""Departures: models that a renderer has on purpose in place of the specification's, and says so.

Each is made of edits of the tracer's source, as a fault is. A renderer that declares one is held to the tracer with
these edits: nothing else is feasible for it. But what one could tell from the truth is as declared, not as due.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

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

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.reference_tracer.arithmetics.behaviour import Function
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData

constant_reflectance: Scalar = 0.0
constant_transmittance: Scalar = 0.0
"""Constants of the behaviour that `split_by_constants` is part of."""


@dataclass(frozen=True)
class Departures:
    """What a renderer computes otherwise on purpose. Raises ValueError for weights that give back more than they get.

    Each field's first value is what the specification says.
    """

    end_of_depth: Literal["black", "background", "local"] = "black"
    """What a reflected or refracted ray brings that may not be traced any more: nothing (TREE-2); the background in its
    direction; or the local terms of what it meets: emission, ambient, diffuse and specular."""
    fresnel: Literal["exact", "schlick", "schlick on the incident side"] = "exact"
    """How a dielectric splits light: by Fresnel's equations (REFR-4); or by Schlick's approximation, with the cosine on
    the side with the lower index, or always with that of the arriving ray."""
    constant_weights: tuple[float, float] | None = None
    """The reflected and the transmitted fraction of a dielectric whatever the angle, in place of Fresnel's; at total
    reflection all is reflected, as ever. None: as `fresnel` says."""
    lit_from: Literal["surface", "offset point"] = "surface"
    """From where the direction and distance to lights are taken: the point of the surface, or where a ray starts that
    leaves it along its normal, on the side that is seen, by the renderer's ray offset."""
    textured_at: Literal["surface", "offset point"] = "surface"
    """At which of the same two points textures are looked up."""
    highlights: Literal["lit", "shadowed", "everywhere"] = "lit"
    """Where lights have highlights: where they light the surface (ILL-3); in shadows, too; or in shadows and on surfaces
    that are turned away from the light."""
    clamped_lambert: bool = False
    """Whether the light that all lights send to a point, each times the cosine, is clamped to 1 in each channel before
    the diffuse reflectance is multiplied with it."""

    def __post_init__(self) -> None:
        weights = self.constant_weights
        if weights is not None and (min(weights) < 0.0 or sum(weights) > 1.0):
            raise ValueError("constant weights of a dielectric are not negative, and add up to at most 1")
        if weights is not None and self.fresnel != "exact":
            raise ValueError("the weights of a dielectric are constant, or follow Schlick's approximation, not both")

    def in_words(self) -> str:
        """All departures as clauses for people, as in `raytruth renderers`."""
        return "; ".join(self._clauses()) or "none"

    def _clauses(self) -> Iterator[str]:
        if self.end_of_depth != "black":
            brought = "background" if self.end_of_depth == "background" else "local terms of what they would meet"
            yield f"paths that end bring the {brought}"
        if self.fresnel != "exact":
            side = " with the cosine of incidence" if self.fresnel != "schlick" else ""
            yield f"Schlick's approximation{side} for Fresnel's equations"
        if self.constant_weights is not None:
            reflected, transmitted = self.constant_weights
            yield f"dielectrics reflect {reflected:.3g} and transmit {transmitted:.3g} at all angles"
        if self.lit_from != "surface":
            yield "surfaces are lit as from where rays leave them"
        if self.textured_at != "surface":
            yield "textures are looked up where rays leave surfaces"
        if self.highlights != "lit":
            where = "in shadows" if self.highlights == "shadowed" else "in shadows and on sides turned away"
            yield f"highlights {where}"
        if self.clamped_lambert:
            yield "the sum of all lights' diffuse light is clamped to 1"


NONE = Departures()


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
