"""Faults in the shared source, beside those of comparisons/faults."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import Subject, words_of
from raytruth.reference_tracer.arithmetics.edits import Edit, edited

if TYPE_CHECKING:
    from collections.abc import Callable


def planted(function: str, *edits: Edit) -> Callable[[Callable[[], None]], Subject]:
    """Make a subject of edits of a function of the tracer; the docstring of what is decorated tells what is wrong."""

    def made(body: Callable[[], None]) -> Subject:
        return Subject(body.__name__, words_of(body), {function: edited(function, *edits)})

    return made


@planted(
    "direct_light",
    Edit("scale(diffuse(scene, material, point), cosine)", "scale(diffuse(scene, material, point), cosine * cosine)"),
)
def cosine_squared() -> None:
    """Lambert's cosine counts twice."""


@planted("phong", Edit("exponent", "0.5 * exponent"))
def half_of_the_exponent() -> None:
    """Phong's highlight is too wide."""


@planted("is_even_square", Edit("(column + row) % 2 == 0", "floor((u + v) / size) % 2 == 0"))
def squares_in_one_floor() -> None:
    """Column and row are added before they are rounded down: diagonal stripes."""


@planted("fresnel_reflectance", Edit("0.5 * perpendicular", "perpendicular"))
def fresnel_without_half() -> None:
    """The two polarisations are added, not averaged."""


@planted(
    "split",
    Edit(
        "reflectance, vector_of(scene, MATERIAL_TRANSMITTANCE, material)",
        "vector_of(scene, MATERIAL_TRANSMITTANCE, material), reflectance",
    ),
)
def exchanged_constants() -> None:
    """What Whitted calls ks is taken for kt."""


@planted("medium_beyond", Edit("integer_of(scene, MATERIAL_OUTSIDE, material)", "-1"))
def always_into_empty_space() -> None:
    """What leaves a bubble is thought to leave the glass around it."""


@planted("distance_to_other_side", Edit("2.0", "1.5"))
def three_quarters_of_the_way() -> None:
    """A ray inside a sphere ends before the other side."""


@planted(
    "snell_discriminant",
    Edit("(ratio - 1.0) * (ratio + 1.0) + cosine * cosine", "abs((ratio - 1.0) * (ratio + 1.0) + cosine * cosine)"),
)
def discriminant_without_sign() -> None:
    """Beyond the critical angle rays are refracted all the same."""
