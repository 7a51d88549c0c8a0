"""Faults in specular highlights (docs/spec.md, ILL-2, ILL-5 and ILL-6)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit


@fault(
    "ILL-2",
    "direct_light",
    "Can a light behind the surface make a highlight on its front?",
    Edit("not faces_light", "False"),
    Edit(
        "is_shadowed(scene, primitive, point, normal, to_light, light_is_near)",
        "faces_light and is_shadowed(scene, primitive, point, normal, to_light, light_is_near)",
    ),
    Edit("scale(diffuse(scene, material, point), cosine)", "scale(diffuse(scene, material, point), max(cosine, 0.0))"),
)
def highlight_on_the_dark_side() -> None:
    """The diffuse term is clamped, but the highlight is added where the light is behind the surface, too."""


@fault(
    "ILL-2",
    "direct_light",
    "Which factors has the specular term of the classical equation?",
    Edit(
        "specular(scene, material, normal, direction, toward_light)",
        "cosine * specular(scene, material, normal, direction, toward_light)",
    ),
)
def highlight_times_cosine() -> None:
    """The highlight is multiplied by n·l like the diffuse term."""


@fault(
    "ILL-2",
    "direct_light",
    "Which colour has a highlight?",
    Edit("PHONG or BLINN", "DIFFUSE and (PHONG or BLINN)"),
    Edit(
        "vector_of(scene, MATERIAL_SPECULAR, material)",
        "multiply(vector_of(scene, MATERIAL_SPECULAR, material), diffuse(scene, material, point))",
    ),
)
def highlight_in_the_diffuse_colour() -> None:
    """The highlight is filtered by the diffuse colour as well as by the specular one."""


@fault(
    "ILL-5",
    "phong",
    "Between which two directions is the angle of Phong's highlight?",
    Edit(
        "dot(mirror_direction(direction, normal), toward_light)",
        "dot(normal, normalize(subtract(toward_light, direction)))",
    ),
)
def blinn_for_phong() -> None:
    """The halfway vector is used in place of the mirror direction, with the same exponent."""


@fault(
    "ILL-5",
    "phong",
    "How often is the cosine multiplied by itself for the exponent 1?",
    Edit("exponent", "exponent + 1.0"),
)
def exponent_off_by_one() -> None:
    """The loop that takes the power runs once too often."""


@fault("ILL-5", "phong", "What is the power of a negative cosine?", Edit("max(cosine, 0.0)", "abs(cosine)"))
def highlight_not_clamped() -> None:
    """The power is taken of the absolute cosine, so there is a second highlight on the opposite side."""


@fault(
    "ILL-6",
    "blinn",
    "Between which two directions is the angle of Blinn's highlight?",
    Edit("dot(normal, normalize(halfway))", "dot(mirror_direction(direction, normal), toward_light)"),
)
def phong_for_blinn() -> None:
    """The mirror direction is used in place of the halfway vector, with the same exponent."""


@fault(
    "ILL-6",
    "blinn",
    "How long is the sum of two unit vectors?",
    Edit("dot(normal, normalize(halfway))", "0.5 * dot(normal, halfway)"),
)
def halfway_vector_not_normalised() -> None:
    """The halfway vector is half the sum of both directions, not made a unit vector."""
