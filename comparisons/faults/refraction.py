"""Faults of refraction (docs/spec.md, REFR-1 to REFR-3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, at_the_start
from raytruth.reference_tracer.source.vector import along, normalize, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


@fault(
    "REFR-1",
    "index_ratio",
    "Does light bend toward the normal when it enters glass, or away from it?",
    Edit("inside / outside if entering else outside / inside", "outside / inside if entering else inside / outside"),
)
def inverted_index_ratio() -> None:
    """The ratio of the indices is upside down."""


@fault(
    "REFR-1",
    "index_ratio",
    "Which medium is around an air bubble in glass?",
    Edit("number_of(scene, MATERIAL_OUTSIDE_INDEX, material)", "1.0"),
)
def empty_space_around_everything() -> None:
    """The medium outside is always taken for empty space, also around a bubble in glass."""


@fault(
    "REFR-1",
    "index_ratio",
    "What changes between the way into the glass and the way out?",
    Edit("inside / outside if entering else outside / inside", "inside / outside"),
)
def same_ratio_on_both_sides() -> None:
    """The same ratio of the indices is used for rays that enter and for rays that leave."""


@fault(
    "REFR-1",
    "index_ratio",
    "How many digits has your index of refraction?",
    Edit("number_of(scene, MATERIAL_INDEX, material)", "1.01 * number_of(scene, MATERIAL_INDEX, material)"),
)
def index_one_percent_off() -> None:
    """The index of refraction is one percent too high."""


@fault("REFR-2", "snell_discriminant", "What becomes of a ray for which Snell's law has no solution?")
def no_total_internal_reflection(cosine: Scalar, ratio: Scalar) -> Scalar:
    """Beyond the critical angle the ray goes on along the surface."""
    return max((ratio - 1.0) * (ratio + 1.0) + cosine * cosine, 0.0)


@fault("REFR-2", "snell_discriminant", "Which quantities are squared in Snell's law?")
def index_ratio_not_squared(cosine: Scalar, ratio: Scalar) -> Scalar:
    """The ratio of the indices is not squared under the root."""
    return ratio - 1.0 + cosine * cosine


@fault("REFR-2", "snell_discriminant", "At which angle exactly does total reflection begin?")
def critical_angle_too_small(cosine: Scalar, ratio: Scalar) -> Scalar:
    """Total internal reflection begins one percent of g² too early."""
    discriminant = (ratio - 1.0) * (ratio + 1.0) + cosine * cosine
    return discriminant if discriminant > 0.01 else -1.0


@fault("REFR-3", "refracted_direction", "What does a straw in a glass of water look like?")
def not_bent(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """The ray goes straight on through the surface."""
    return direction


@fault("REFR-3", "refracted_direction", "How long is the refracted direction?")
def refracted_direction_not_normalised(
    direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar
) -> Vector:
    """The division by the ratio of the indices is forgotten, so the direction is no unit vector."""
    return along(direction, normal, cosine - g)


@fault("REFR-3", "refracted_direction", "To which side of the surface does the refracted ray go?")
def normal_of_the_wrong_side(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """The term along the normal has the wrong sign."""
    return scale(along(direction, normal, cosine + g), 1.0 / ratio)


@fault("REFR-3", "refracted_direction", "Follow a ray through a slab of glass: in which direction does it come out?")
def bent_on_the_way_in_only(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """Rays are bent where they enter the glass, and go straight on where they leave it."""
    if ratio > 1.0:
        return scale(along(direction, normal, cosine - g), 1.0 / ratio)
    return direction


@fault(
    "REFR-3",
    "refracted_direction",
    "Split the refracted direction into a part along the surface and one along the normal: how long is each?",
)
def angles_in_place_of_sines(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """The part along the surface is divided by the ratio, and the part along the normal is left as it was."""
    tangential = along(direction, normal, cosine)
    return normalize(along(scale(tangential, 1.0 / ratio), normal, -cosine))


@fault(
    "REFR-5",
    "transmitted_ray",
    "Does the image stay as sharp and bright behind two panes as behind one?",
    at_the_start("""
        if medium < 0:
            weight = scale(weight, 0.99)
        """),
)
def dimmer_after_the_second_refraction() -> None:
    """Rays that leave into empty space lose one percent, so it is right until the second refraction."""
