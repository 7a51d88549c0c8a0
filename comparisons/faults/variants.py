"""Legitimate variants: right renderers that compute otherwise than the truth's source does, and must not be flagged.

Each declares what it is: the arithmetic, where its rays start, what it writes.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Literal

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.faults import other_formulas, other_searches, other_starts
from raytruth.comparisons.faults.fault import STUDENT, Array, Finish, Subject, subjects_in
from raytruth.comparisons.records.srgb import srgb_decoded, srgb_encoded
from raytruth.reference_tracer.arithmetics.textbook_forms import VARIANTS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.reference_tracer.arithmetics.edits import Function

# Of float32's 24 bits two, for exponentials, tangents and powers from the mathematical library.
FLOAT32_MODEL = ErrorModel("float32 with 2 bits for the mathematical library", precision_bits=22)
# Far above the rounding of float64 in scenes of this size, and far below what can be seen.
OFFSET = other_starts.OFFSET


def _variant(
    name: str,
    words: str,
    overrides: Mapping[str, Function] | None = None,
    *,
    declares: ErrorModel = STUDENT,
    numbers: Literal["float64", "float32"] = "float64",
    finish: Finish | None = None,
) -> Subject:
    return Subject(name, words, overrides or {}, finish, numbers, declares=declares)


@cache
def all_variants() -> dict[str, Subject]:
    """Every legitimate variant, by name."""
    made = [*_textbook_forms(), *_ray_starts(), *_number_formats(), *_outputs()]
    return subjects_in((other_formulas, other_searches)) | {variant.name: variant for variant in made}


def _textbook_forms() -> list[Subject]:
    """Those of the speed-accuracy study; its Möller-Trumbore has a threshold that depends on the scale."""
    return [
        _variant(name, "; ".join(_first_line(body) for body in overrides.values()), overrides)
        for name, overrides in VARIANTS.items()
        if name != "moeller-trumbore"
    ]


def _ray_starts() -> list[Subject]:
    beside = replace(STUDENT, ray_offset=RayOffset(absolute=OFFSET))
    later = replace(STUDENT, ray_offset=RayOffset(minimum_distance=OFFSET, excludes_surface=False))
    sooner = replace(STUDENT, shadow_shortening=OFFSET)
    hits_later = {
        "distance_to_sphere": other_starts.sphere_not_too_near,
        "distance_to_triangle": other_starts.triangle_not_too_near,
        "distance_to_plane": other_starts.plane_not_too_near,
    }
    return [
        _variant(
            "offset along the normal",
            "Rays start a little beside the surface that they leave.",
            {"departure": other_starts.beside_the_surface},
            declares=beside,
        ),
        _variant(
            "least distance of hits", "Hits are ignored very near to where a ray starts.", hits_later, declares=later
        ),
        _variant(
            "shadow rays end early",
            "Shadow rays end a little before the light.",
            {"shadow_ray_end": other_starts.a_little_before_the_light},
            declares=sooner,
        ),
    ]


def _number_formats() -> list[Subject]:
    return [
        _variant("float32", "Everything is computed in float32.", declares=FLOAT32_MODEL, numbers="float32"),
        _variant(
            "float32, 8 bits written",
            "Everything is computed in float32 and written as an 8-bit sRGB picture.",
            declares=replace(FLOAT32_MODEL, output=OutputModel("uint8", "sRGB", clipped=True)),
            numbers="float32",
            finish=_as_bytes,
        ),
    ]


def _outputs() -> list[Subject]:
    formats = {
        "8-bit sRGB": (OutputModel("uint8", "sRGB", clipped=True), _as_bytes),
        "8-bit linear, truncated": (OutputModel("uint8", rounding="truncation", clipped=True), _as_truncated_bytes),
        "16-bit linear": (OutputModel("uint16", clipped=True), _as_words),
        "half floats": (OutputModel("float16"), _as_halves),
        "double floats": (OutputModel("float64"), _as_it_is),
    }
    return [
        _variant(name, f"Values are written as {name}.", declares=replace(STUDENT, output=output), finish=finish)
        for name, (output, finish) in formats.items()
    ]


def _as_it_is(image: Array) -> Array:
    return image


def _as_bytes(image: Array) -> Array:
    return srgb_decoded(np.floor(srgb_encoded(np.clip(image, 0.0, 1.0)) * 255.0 + 0.5) / 255.0)


def _as_truncated_bytes(image: Array) -> Array:
    return np.floor(np.clip(image, 0.0, 1.0) * 255.0) / 255.0


def _as_words(image: Array) -> Array:
    return np.floor(np.clip(image, 0.0, 1.0) * 65535.0 + 0.5) / 65535.0


def _as_halves(image: Array) -> Array:
    return image.astype(np.float16).astype(np.float64)


def _first_line(function: Function) -> str:
    return (function.__doc__ or "").split("\n")[0].strip()
