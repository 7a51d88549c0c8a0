"""From what a user declares to the error model that the program is held to.

What can be declared but not yet be judged is refused in a sentence, and never passed over.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from raytruth.comparisons.error_models.error_model import ErrorModel, RayOffset
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.renderers.program.output_images import numbers_of
from raytruth.scenes.wording import described

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.renderers.program.declaration import Declaration, Rays

Location = tuple[str, ...]

# Of float64's 53 bits 14 are left for other formulas and another order of operations: a tracer of its own, written from
# the specification, passed the whole library so, also compiled with -O3 -ffast-math and fused multiply-adds.
DEFAULT_BITS = 39
PRECISIONS = {"float64": 53, "float32": 24}
FEWEST_BITS = 8
"""As the key `bits` has it: with fewer nearly everything is left open."""

# An angle is converted with some eight roundings of float64, which is 2^-50 of it.
MOST_BITS_OF_ANGLES = 49

TRIANGLE_TESTS: dict[str, Literal["watertight", "moeller-trumbore", "pluecker"]] = {
    "watertight": "watertight",
    "moeller-trumbore": "moeller-trumbore",
    "pluecker": "pluecker",
}
SPHERE_POINTS: dict[str, Literal["along the ray", "normalised"]] = {
    "divided": "along the ray",
    "normalised": "normalised",
}

JUDGED: dict[Location, tuple[Any, ...]] = {
    ("arithmetic", "smallest"): (0.0,),
    ("rays", "relative_least_distance"): (0.0,),
    ("formulas", "sphere"): ("accurate",),
    ("formulas", "triangle"): tuple(TRIANGLE_TESTS),
    ("formulas", "fresnel"): ("accurate",),
    ("formulas", "refraction"): ("accurate",),
    ("formulas", "directions"): ("normalised",),
}
"""The values that error models know today, of the keys of which they do not know all."""

KINDS_OF_RAYS = ("shadow", "reflected", "refracted")


def not_judged_yet(declaration: Declaration) -> Iterator[tuple[Location, str]]:
    """Place and sentence for each value that can be declared, but that no error model expresses yet."""
    for location, values in JUDGED.items():
        value = getattr(getattr(declaration, location[0]), location[1])
        if value not in values:
            known = " or ".join(described(known) for known in values)
            yield location, f"{described(value)} cannot be judged yet; so far expected {known}."
    for kind in KINDS_OF_RAYS:
        for key, value in getattr(declaration.rays, kind) or ():
            if value not in (None, getattr(declaration.rays, key)):
                told = "a value of its own for one kind of ray cannot be judged yet; state it under [rays] for all."
                yield ("rays", kind, key), told


def contradictions(declaration: Declaration) -> Iterator[tuple[Location, str]]:
    """Place and sentence for each key that does not go with another."""
    arithmetic, rays, formulas = declaration.arithmetic, declaration.rays, declaration.formulas
    if arithmetic.bits is not None and arithmetic.precision is not None:
        yield ("arithmetic", "bits"), "expected either precision or bits, found both; leave one out."
    elif precision_bits(declaration) < FEWEST_BITS:
        yield (
            ("arithmetic", "slack_bits"),
            f"expected to leave {FEWEST_BITS} bits at least, found more slack.",
        )
    if own_surface(rays) == "excluded" and (rays.least_distance > 0 or rays.along == "ray"):
        told = "with a least distance or an offset along the ray only 'tested' can be judged yet."
        yield ("rays", "own_surface"), told
    if formulas.triangle == "watertight" and formulas.triangle_points == "barycentric":
        yield ("formulas", "triangle_points"), "expected 'along the ray' with the triangle test 'watertight'."
    if declaration.conventions.field_of_view != "vertical" and precision_bits(declaration) > MOST_BITS_OF_ANGLES:
        told = f"expected at most {MOST_BITS_OF_ANGLES} bits with a field of view that is not vertical"
        yield ("arithmetic", "precision"), f"{told}, since the angle told is rounded; leave slack_bits."
    yield from _contradictions_of_model(declaration)
    if declaration.sampling.samples:
        if (declaration.conventions.pixel, declaration.conventions.pitch) != ("centre", "size"):
            told = "expected rays through the centres of pixels, since samples are drawn; leave pixel and pitch out."
            yield ("conventions", "pixel"), told
        if not declaration.uses("seed"):
            yield ("command",), "expected the placeholder {seed}, since samples are drawn; add it."
        if declaration.writes not in {"exr", "pfm"} or declaration.clipped:
            yield ("writes",), "expected 'exr' or 'pfm', not clipped, since the mean of pictures is judged."


def _contradictions_of_model(declaration: Declaration) -> Iterator[tuple[Location, str]]:
    model, rays = declaration.model, declaration.rays
    weights = model.constant_weights
    if weights is not None and sum(weights) > 1.0:
        yield ("model", "constant_weights"), f"expected two weights that add up to at most 1, found {sum(weights):g}."
    for key in ("fresnel", "constant_weights"):
        if getattr(model, key) not in {"exact", None} and declaration.formulas.fresnel != "accurate":
            yield ("formulas", "fresnel"), f"expected none beside {key} under [model]; leave it out."
    if weights is not None and model.fresnel != "exact":
        yield ("model", "constant_weights"), "expected these or fresnel, found both; leave one out."
    for key in ("lit_from", "textured_at"):
        if getattr(model, key) != "surface" and not (rays.offset or rays.relative_offset):
            yield ("model", key), "expected an offset under [rays] with 'offset point'; state it."


def own_surface(rays: Rays) -> Literal["excluded", "tested"]:
    """What becomes of the surface that a ray leaves."""
    if rays.own_surface is not None:
        return rays.own_surface
    return "tested" if rays.least_distance > 0 or rays.along == "ray" else "excluded"


def precision_bits(declaration: Declaration) -> int:
    """The bits of one operation, less what is left for slack."""
    arithmetic = declaration.arithmetic
    bits = PRECISIONS[arithmetic.precision] if arithmetic.precision else arithmetic.bits or DEFAULT_BITS
    return bits - arithmetic.slack_bits


def error_model_of_declaration(declaration: Declaration) -> ErrorModel:
    """The error model of a program of which nothing is told by the two functions above."""
    rays, formulas = declaration.rays, declaration.formulas
    bits = precision_bits(declaration)
    return ErrorModel(
        f"numbers of {bits} bits, as declared",  # no name in it: programs that declare the same share feasible sets
        precision_bits=bits,
        ray_offset=RayOffset(
            absolute=rays.offset,
            relative=rays.relative_offset,
            along="normal" if rays.along == "normal" else "direction",
            minimum_distance=rays.least_distance,
            excludes_surface=own_surface(rays) == "excluded",
        ),
        shadow_shortening=rays.shadow_shortening,
        triangle_test=TRIANGLE_TESTS[formulas.triangle],
        triangle_points=formulas.triangle_points,
        sphere_points=SPHERE_POINTS[formulas.sphere_normals],
        camera_rays=declaration.conventions.camera_rays(),
        field_of_view=declaration.conventions.field_of_view,
        departures=declaration.model.departures(),
        output=output_model_of(declaration),
        random_choices="whatever its samples need" if declaration.sampling.samples else "",
    )


def output_model_of(declaration: Declaration) -> OutputModel:
    """The output model that follows from the format of the program's picture."""
    numbers = numbers_of(declaration.writes, declaration.numbers)
    conventions, is_one = declaration.conventions, declaration.sampling.samples == 0
    return OutputModel(
        numbers,
        transfer="sRGB" if declaration.colours == "srgb" else "linear",
        rounding="nearest" if declaration.rounding == "nearest" else "truncation",
        clipped=numbers in {"uint8", "uint16"} or bool(declaration.clipped) or (conventions.clamped_samples and is_one),
        scale=conventions.scale,
    )
