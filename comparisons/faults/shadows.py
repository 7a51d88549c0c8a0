"""Faults of shadow rays (docs/spec.md, SHAD), and of where rays start that leave a surface (TRAV-5)."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.comparisons.faults.other_formulas import MOELLER_TRUMBORE
from raytruth.reference_tracer.arithmetics.edits import Edit, before
from raytruth.reference_tracer.source.features import PLANES, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.scene_data import (
    PLANE_MATERIAL,
    SPHERE_MATERIAL,
    SceneData,
    first_plane,
    rows_of,
)
from raytruth.reference_tracer.source.shadow import shadow_ray_end
from raytruth.reference_tracer.source.traversal import (
    NOTHING,
    distance_to_plane,
    distance_to_sphere,
    distance_to_triangle,
    is_occluded,
)
from raytruth.reference_tracer.source.vector import add, along, dot, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


def each_primitive_asked(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """The tracer's is_occluded without its tree: where some are left out, each primitive has to be asked."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    planes = first_plane(scene)
    for primitive in range(planes + rows_of(scene, PLANE_MATERIAL)):
        distance = inf
        if SPHERES:
            if primitive < spheres:
                distance = distance_to_sphere(scene, origin, direction, left, primitive)
        if TRIANGLES:
            if primitive >= spheres and primitive < planes:
                distance = distance_to_triangle(scene, origin, direction, left - spheres, primitive - spheres)
        if PLANES:
            if primitive >= planes:
                distance = distance_to_plane(scene, origin, direction, left - planes, primitive - planes)
        if distance < end:
            return True
    return False


@fault("SHAD-1", "is_shadowed", "What can keep the light away from a point?")
def no_shadow_rays(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """There are no shadow rays: everything that faces a light is lit by it."""
    return False


@fault("SHAD-1", "is_shadowed", "How far does a shadow ray have to look?", Edit("shadow_ray_end()", "inf"))
def shadow_ray_not_limited() -> None:
    """The shadow ray is not limited to the light's distance, so objects behind the light cast shadows."""


@fault(
    "SHAD-1",
    "is_shadowed",
    "In which unit is t measured along your shadow ray?",
    Edit("subtract(add(point, to_light), origin)", "normalize(to_light)"),
)
def shadow_ray_of_length_one() -> None:
    """The shadow ray's direction is made a unit vector but t is still compared with 1."""


@fault(
    "SHAD-2",
    "is_shadowed",
    "Which objects can stand between a point and the sun?",
    Edit("is_occluded(scene, origin, to_light, left, inf)", "False"),
)
def sun_throws_no_shadows() -> None:
    """Only point lights throw shadows; directional ones go through everything."""


@fault("SHAD-2", "is_shadowed", "How far away may something be that hides the sun?", Edit("inf", "shadow_ray_end()"))
def sun_shadows_end_early() -> None:
    """Shadow rays to directional lights end at t = 1 like those to point lights."""


@fault(
    "SHAD-3",
    "is_occluded",
    "What does the specification say about the shadow of glass?",
    before(
        """
        if distance < end:
            return True
        """,
        """
        if DIELECTRICS:
            if integer_of(scene, MATERIAL_IS_DIELECTRIC, material_of(scene, primitive)):
                distance = inf
        """,
    ),
    of=each_primitive_asked,
)
def glass_throws_no_shadow() -> None:
    """Shadow rays go through glass, since it is transparent."""


@fault(
    "SHAD-3",
    "is_occluded",
    "Can a lamp throw a shadow?",
    before(
        """
        if distance < end:
            return True
        """,
        """
        if EMISSION:
            material = material_of(scene, primitive)
            red = vector_of(scene, MATERIAL_EMISSION, material)[0]
            if red > 0.0 or integer_of(scene, MATERIAL_EMISSION_BOARD, material) >= 0:
                distance = inf
        """,
    ),
    of=each_primitive_asked,
)
def emitters_throw_no_shadow() -> None:
    """Shadow rays go through glowing objects, since those are lights themselves."""


@fault("SHAD-3", "is_occluded", "Which kinds of objects does your shadow ray look at?", Edit("TRIANGLES", "False"))
def triangles_throw_no_shadow() -> None:
    """Shadow rays look for spheres only."""


@fault("SHAD-3", "is_occluded", "What does the light behind a wall do to the room?", Edit("PLANES", "False"))
def planes_throw_no_shadow() -> None:
    """Shadow rays do not look for planes, so lamps shine through walls."""


@fault("SHAD-4", "departure", "Where does rounding put the start of the ray: before or behind the surface?")
def shadow_acne(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """Rays start on the surface itself without any offset, and half of them meet it at once."""
    return point, NOTHING


@fault("SHAD-4", "departure", "How far from the surface does your ray start, in units of the smallest object?")
def epsilon_too_large(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """Rays start 0.05 above the surface, so shadows come loose from what throws them."""
    return along(point, normal, 0.05), NOTHING


@fault("SHAD-4", "departure", "To which side of the surface does your ray start, and to which side does it go?")
def epsilon_to_the_wrong_side(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """The small offset has the wrong sign, so rays start below the surface."""
    return along(point, normal, -1e-4), NOTHING


@fault(
    "SHAD-4",
    "is_occluded",
    "Can an object stand in its own light?",
    before(
        """
        if distance < end:
            return True
        """,
        """
        are_triangles = primitive >= spheres and left >= spheres
        if primitive == left or (are_triangles and material_of(scene, primitive) == material_of(scene, left)):
            distance = inf
        """,
    ),
    of=each_primitive_asked,
)
def no_object_shadows_itself() -> None:
    """All of the object that a shadow ray starts on is left out, not only the point itself."""


@fault("SHAD-5", "is_shadowed", "Look at where two objects touch: does light shine through?")
def light_leaks(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Whatever is nearer than 0.1 to the start of a shadow ray is ignored, so light leaks in at corners."""
    later = along(point, normalize(to_light), 0.1)
    if light_is_near:
        rest = subtract(add(point, to_light), later)
        return dot(rest, to_light) > 0.0 and is_occluded(scene, later, rest, NOTHING, shadow_ray_end())
    return is_occluded(scene, later, to_light, NOTHING, inf)


@fault("TRAV-5", "departure", "How large is your epsilon beside the objects of this scene?")
def fixed_epsilon(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """Rays start 0.001 off the surface, however small the scene is."""
    side = 1e-3 if dot(normal, direction) > 0.0 else -1e-3
    return along(point, normal, side), NOTHING


@fault(
    "TRAV-5",
    "triangle_distance",
    "In which unit is your determinant, and when is it small?",
    Edit("determinant == 0.0", "abs(determinant) < 1e-4"),
    of=MOELLER_TRUMBORE,
)
def fixed_determinant_threshold() -> None:
    """A determinant below 0.0001 counts as parallel, so small triangles vanish."""
