"""From what a user declares to the error model that the program is held to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from raytruth.comparisons.error_models.error_model import ErrorModel, TriangleTest
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.renderers.program.declaration import LeavingRays
from raytruth.comparisons.renderers.program.output_images import numbers_of
from raytruth.scenes.wording import described

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from raytruth.comparisons.error_models.formulas import Formula
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

TRIANGLE_TESTS: dict[str, TriangleTest] = {"moeller-trumbore": "moeller-trumbore of 1997"}
"""Those that an error model calls otherwise: of Möller and Trumbore's it has Embree's, too."""
SPHERE_POINTS: dict[str, Literal["along the ray", "normalised"]] = {
    "divided": "along the ray",
    "normalised": "normalised",
}


KEYS = {"sphere_test": "sphere", "sphere_points": "sphere_normals", "triangle_test": "triangle"}
"""Of [formulas] in place of fields of an error model that are called otherwise."""


def formula_in_file(formula: Formula) -> tuple[str, str] | None:
    """Key and value that state a formula in a declaration; None for one that no file can state, or only by default."""
    key = KEYS.get(formula.field, formula.field)
    names: dict[str, Mapping[str, str]] = {"triangle_test": TRIANGLE_TESTS, "sphere_points": SPHERE_POINTS}
    own = names.get(formula.field, {})
    stated = {value: word for word, value in own.items()}
    if formula.value == "as in the truth" or (formula.value in own and formula.value not in stated):
        return None
    return key, stated.get(formula.value, formula.value)


def contradictions(declaration: Declaration) -> Iterator[tuple[Location, str]]:
    """Place and sentence for each key that does not go with another."""
    arithmetic, formulas = declaration.arithmetic, declaration.formulas
    if arithmetic.bits is not None and arithmetic.precision is not None:
        yield ("arithmetic", "bits"), "expected either precision or bits, found both; leave one out."
    elif precision_bits(declaration) < FEWEST_BITS:
        yield (
            ("arithmetic", "slack_bits"),
            f"expected to leave {FEWEST_BITS} bits at least, found more slack.",
        )
    if formulas.triangle in {"watertight", "plane and inside"} and formulas.triangle_points == "barycentric":
        told = f"expected 'along the ray' with the triangle test {described(formulas.triangle)}, which has no weights."
        yield ("formulas", "triangle_points"), told
    if formulas.least_determinant > 0.0 and formulas.triangle != "moeller-trumbore":
        told = "expected the triangle test 'moeller-trumbore' beside it; leave it out."
        yield ("formulas", "least_determinant"), told
    if declaration.conventions.field_of_view != "vertical" and precision_bits(declaration) > MOST_BITS_OF_ANGLES:
        told = f"expected at most {MOST_BITS_OF_ANGLES} bits with a field of view that is not vertical"
        yield ("arithmetic", "precision"), f"{told}, since the angle told is rounded; leave slack_bits."
    if declaration.family is not None and not declaration.reference:
        yield ("family",), "expected reference = true beside it, since others have no opinion that counts; add it."
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


def precision_bits(declaration: Declaration) -> int:
    """The bits of one operation, less what is left for slack."""
    arithmetic = declaration.arithmetic
    bits = PRECISIONS[arithmetic.precision] if arithmetic.precision else arithmetic.bits or DEFAULT_BITS
    return bits - arithmetic.slack_bits


def error_model_of_declaration(declaration: Declaration) -> ErrorModel:
    """The error model of a program of which nothing is told by the function above."""
    rays, formulas = declaration.rays, declaration.formulas
    bits = precision_bits(declaration)
    offset = declared_offset(rays)
    shadow = declared_offset(rays, rays.shadow)
    return ErrorModel(
        f"numbers of {bits} bits, as declared",  # no name in it: programs that declare the same share feasible sets
        precision_bits=bits,
        ray_offset=offset,
        shadow_offset=shadow if shadow != offset else None,
        reflected_offset=declared_offset(rays, rays.reflected) if rays.reflected else None,
        refracted_offset=declared_offset(rays, rays.refracted) if rays.refracted else None,
        shadow_aim=rays.shadow_aim or ("either" if shadow.moves_rays else "light"),
        shadow_shortening=rays.shadow_shortening,
        triangle_test=TRIANGLE_TESTS.get(formulas.triangle, formulas.triangle),
        least_determinant=formulas.least_determinant,
        triangle_points=formulas.triangle_points,
        sphere_test=formulas.sphere,
        sphere_points=SPHERE_POINTS[formulas.sphere_normals],
        directions=formulas.directions or "as in the truth",
        fresnel=formulas.fresnel,
        refraction=formulas.refraction,
        smallest=declaration.arithmetic.smallest,
        camera_rays=declaration.conventions.camera_rays(),
        field_of_view=declaration.conventions.field_of_view,
        departures=declaration.model.departures(),
        output=output_model_of(declaration),
        random_choices="whatever its samples need" if declaration.sampling.samples else "",
    )


def declared_offset(rays: Rays, of_kind: LeavingRays | None = None) -> RayOffset:
    """Where rays start that leave a surface: all, or those of one kind for which something is stated apart."""
    own = of_kind or LeavingRays()
    least = rays.least_distance if own.least_distance is None else own.least_distance
    scaled = own.relative_least_distance
    relative_least = rays.relative_least_distance if scaled is None else scaled
    along = own.along or rays.along
    surface = own.own_surface or rays.own_surface
    if surface is None:
        surface = "tested" if least > 0 or relative_least > 0 or along == "ray" else "excluded"
    return RayOffset(
        absolute=rays.offset if own.offset is None else own.offset,
        relative=rays.relative_offset if own.relative_offset is None else own.relative_offset,
        along="normal" if along == "normal" else "direction",
        minimum_distance=least,
        relative_minimum_distance=relative_least,
        excludes_surface=surface == "excluded",
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
