"""Faults of refraction (docs/spec.md, REFR-1 to REFR-3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.scene_data import MATERIAL_INDEX, MATERIAL_OUTSIDE_INDEX, number_of
from raytruth.reference_tracer.source.shadow import departure
from raytruth.reference_tracer.source.vector import along, negate, normalize, scale

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.ray_tree import Ray
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault("REFR-1", "index_ratio", "Does light bend toward the normal when it enters glass, or away from it?")
def inverted_index_ratio(scene: SceneData, material: int, entering: bool) -> Scalar:
    """The ratio of the indices is upside down."""
    inside = number_of(scene, MATERIAL_INDEX, material)
    outside = number_of(scene, MATERIAL_OUTSIDE_INDEX, material)
    return outside / inside if entering else inside / outside


@fault("REFR-1", "index_ratio", "Which medium is around an air bubble in glass?")
def empty_space_around_everything(scene: SceneData, material: int, entering: bool) -> Scalar:
    """The medium outside is always taken for empty space, also around a bubble in glass."""
    inside = number_of(scene, MATERIAL_INDEX, material)
    return inside if entering else 1.0 / inside


@fault("REFR-1", "index_ratio", "What changes between the way into the glass and the way out?")
def same_ratio_on_both_sides(scene: SceneData, material: int, entering: bool) -> Scalar:
    """The same ratio of the indices is used for rays that enter and for rays that leave."""
    return number_of(scene, MATERIAL_INDEX, material) / number_of(scene, MATERIAL_OUTSIDE_INDEX, material)


@fault("REFR-1", "index_ratio", "How many digits has your index of refraction?")
def index_one_percent_off(scene: SceneData, material: int, entering: bool) -> Scalar:
    """The index of refraction is one percent too high."""
    inside = 1.01 * number_of(scene, MATERIAL_INDEX, material)
    outside = number_of(scene, MATERIAL_OUTSIDE_INDEX, material)
    return inside / outside if entering else outside / inside


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


@fault("REFR-3", "refracted_direction", "Compare sin θ with θ.")
def angles_in_place_of_sines(direction: Vector, normal: Vector, cosine: Scalar, g: Scalar, ratio: Scalar) -> Vector:
    """The part along the surface is divided by the ratio, and the part along the normal is left as it was."""
    tangential = along(direction, normal, cosine)
    return normalize(along(scale(tangential, 1.0 / ratio), normal, -cosine))


@fault("REFR-5", "transmitted_ray", "Does the image stay as sharp and bright behind two panes as behind one?")
def dimmer_after_the_second_refraction(
    primitive: int, point: Vector, normal: Vector, refracted: Vector, weight: Vector, medium: int, depth: int
) -> Ray:
    """Rays that leave into empty space lose one percent, so it is right until the second refraction."""
    start, left = departure(primitive, point, negate(normal), refracted)
    kept = weight
    if medium < 0:
        kept = scale(weight, 0.99)
    return start, refracted, kept, left, medium, depth - 1
