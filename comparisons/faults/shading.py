"""Faults in the terms of local illumination (docs/spec.md, ILL)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, after
from raytruth.reference_tracer.source.features import DIRECTIONAL_LIGHTS, POINT_LIGHTS
from raytruth.reference_tracer.source.scene_data import (
    AMBIENT_LIGHT,
    LIGHT_POSITION,
    MATERIAL_AMBIENT,
    SUN_DIRECTION,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.vector import multiply, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault(
    "ILL-2",
    "direct_light",
    "Which sign has n·l where the light is behind the surface?",
    Edit("not faces_light", "False"),
    Edit(
        "is_shadowed(scene, primitive, point, normal, to_light, light_is_near)",
        "faces_light and is_shadowed(scene, primitive, point, normal, to_light, light_is_near)",
    ),
)
def missing_clamp() -> None:
    """The cosine is not clamped to 0, so a light behind the surface takes light away."""


@fault(
    "ILL-2",
    "direct_light",
    "Which side of the surface does the light shine on, and which one do you see?",
    Edit("not faces_light", "False"),
    Edit("scale(diffuse(scene, material, point), cosine)", "scale(diffuse(scene, material, point), abs(cosine))"),
)
def lit_through_the_surface() -> None:
    """The absolute value of the cosine is taken, so a light behind the surface lights its front."""


@fault(
    "ILL-2",
    "direct_light",
    "How does the brightness change where light arrives at a slant?",
    Edit("scale(diffuse(scene, material, point), cosine)", "diffuse(scene, material, point)"),
)
def no_cosine() -> None:
    """The diffuse term lacks n·l, so a lit sphere looks like a disc."""


@fault(
    "ILL-2",
    "direct_light",
    "Look at the line between day and night: is it sharp?",
    Edit("not faces_light", "cosine < 0.05"),
)
def grazing_light_dropped() -> None:
    """Light that arrives at a cosine below 0.05 is dropped, against noise at the border of day and night."""


@fault("ILL-2", "direct_light", "How long is l?", Edit("dot(normal, toward_light)", "dot(normal, to_light)"))
def light_direction_not_normalised() -> None:
    """The direction to the light is not made a unit vector, so n·l grows with the distance."""


@fault("ILL-2", "ambient", "How often does ambient light arrive?")
def ambient_once_a_light(scene: SceneData, material: int) -> Vector:
    """The ambient term stands within the loop over the lights."""
    once = multiply(vector_of(scene, MATERIAL_AMBIENT, material), vector_of(scene, AMBIENT_LIGHT, 0))
    lights = 0
    if POINT_LIGHTS:
        lights += rows_of(scene, LIGHT_POSITION)
    if DIRECTIONAL_LIGHTS:
        lights += rows_of(scene, SUN_DIRECTION)
    return scale(once, float(lights))


@fault("ILL-2", "ambient", "Which two factors has the ambient term?")
def ambient_light_not_filtered(scene: SceneData, material: int) -> Vector:
    """The ambient light comes back in full, not times the ambient reflectance of the surface."""
    return vector_of(scene, AMBIENT_LIGHT, 0)


@fault(
    "ILL-2",
    "diffuse",
    "Do all your terms add up to what arrives?",
    Edit("1.0 / pi", "0.99 / pi"),
    Edit("return reflectance", "return scale(reflectance, 0.99)"),
)
def diffuse_one_percent_too_dark() -> None:
    """One percent of the diffuse light is lost."""


@fault("ILL-2", "diffuse", "Which units has the classical equation?", Edit("RADIOMETRIC", "True"))
def pi_in_the_classical_equation() -> None:
    """The diffuse term is divided by π in the classical convention, too."""


@fault(
    "ILL-3",
    "diffuse",
    "How much of the light that arrives does Lambert's surface send to one direction?",
    Edit("RADIOMETRIC", "False"),
)
def no_pi() -> None:
    """The reflectance is used for the radiance without division by π."""


@fault("ILL-3", "diffuse", "How many digits has your 1/π?", Edit("1.0 / pi", "0.318"))
def rounded_inverse_pi() -> None:
    """1/π is written as 0.318."""


@fault(
    "ILL-8",
    "diffuse",
    "What stands where a colour is not stated?",
    after(
        "reflectance = textured(scene, MATERIAL_DIFFUSE, MATERIAL_DIFFUSE_BOARD, material, point)",
        """
        if reflectance[0] + reflectance[1] + reflectance[2] == 0.0:
            reflectance = (0.1, 0.1, 0.1)
        """,
    ),
)
def missing_diffuse_is_grey() -> None:
    """A material that states no diffuse term gets a dark grey one."""
