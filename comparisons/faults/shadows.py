"""Faults of shadow rays (docs/spec.md, SHAD), and of where rays start that leave a surface (TRAV-5)."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.source.features import DIELECTRICS, EMISSION, SPHERES, TRIANGLES
from raytruth.reference_tracer.source.scene_data import (
    MATERIAL_EMISSION,
    MATERIAL_EMISSION_BOARD,
    MATERIAL_IS_DIELECTRIC,
    SPHERE_MATERIAL,
    SPHERE_RADIUS,
    TRIANGLE_MATERIAL,
    SceneData,
    integer_of,
    rows_of,
    vector_of,
)
from raytruth.reference_tracer.source.shadow import departure, shadow_ray_end
from raytruth.reference_tracer.source.traversal import (
    NOTHING,
    distance_to_sphere,
    distance_to_triangle,
    is_occluded,
    material_of,
)
from raytruth.reference_tracer.source.vector import add, along, cross, dot, normalize, subtract

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector


@fault("SHAD-1", "is_shadowed", "What can keep the light away from a point?")
def no_shadow_rays(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """There are no shadow rays: everything that faces a light is lit by it."""
    return False


@fault("SHAD-1", "is_shadowed", "How far does a shadow ray have to look?")
def shadow_ray_not_limited(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """The shadow ray is not limited to the light's distance, so objects behind the light cast shadows."""
    origin, left = departure(primitive, point, normal, to_light)
    return is_occluded(scene, origin, to_light, left, inf)


@fault("SHAD-1", "is_shadowed", "In which unit is t measured along your shadow ray?")
def shadow_ray_of_length_one(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """The shadow ray's direction is made a unit vector but t is still compared with 1."""
    origin, left = departure(primitive, point, normal, to_light)
    if light_is_near:
        return is_occluded(scene, origin, normalize(to_light), left, shadow_ray_end())
    return is_occluded(scene, origin, to_light, left, inf)


@fault("SHAD-2", "is_shadowed", "Which objects can stand between a point and the sun?")
def sun_throws_no_shadows(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Only point lights throw shadows; directional ones go through everything."""
    origin, left = departure(primitive, point, normal, to_light)
    if light_is_near:
        return is_occluded(scene, origin, subtract(add(point, to_light), origin), left, shadow_ray_end())
    return False


@fault("SHAD-2", "is_shadowed", "How far away may something be that hides the sun?")
def sun_shadows_end_early(
    scene: SceneData, primitive: int, point: Vector, normal: Vector, to_light: Vector, light_is_near: bool
) -> bool:
    """Shadow rays to directional lights end at t = 1 like those to point lights."""
    origin, left = departure(primitive, point, normal, to_light)
    return is_occluded(scene, origin, to_light, left, shadow_ray_end())


@fault("SHAD-3", "is_occluded", "What does the specification say about the shadow of glass?")
def glass_throws_no_shadow(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """Shadow rays go through glass, since it is transparent."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if SPHERES:
        for sphere in range(spheres):
            transparent = False
            if DIELECTRICS:
                transparent = integer_of(scene, MATERIAL_IS_DIELECTRIC, material_of(scene, sphere)) == 1
            if not transparent and distance_to_sphere(scene, origin, direction, left, sphere) < end:
                return True
    if TRIANGLES:
        for triangle in range(rows_of(scene, TRIANGLE_MATERIAL)):
            transparent = False
            if DIELECTRICS:
                transparent = integer_of(scene, MATERIAL_IS_DIELECTRIC, material_of(scene, spheres + triangle)) == 1
            if not transparent and distance_to_triangle(scene, origin, direction, left - spheres, triangle) < end:
                return True
    return False


@fault("SHAD-3", "is_occluded", "Can a lamp throw a shadow?")
def emitters_throw_no_shadow(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """Shadow rays go through glowing objects, since those are lights themselves."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    if SPHERES:
        for sphere in range(spheres):
            glows = False
            if EMISSION:
                glows = vector_of(scene, MATERIAL_EMISSION, material_of(scene, sphere))[0] > 0.0
            if not glows and distance_to_sphere(scene, origin, direction, left, sphere) < end:
                return True
    if TRIANGLES:
        for triangle in range(rows_of(scene, TRIANGLE_MATERIAL)):
            glows = False
            if EMISSION:
                material = material_of(scene, spheres + triangle)
                glows = (
                    integer_of(scene, MATERIAL_EMISSION_BOARD, material) >= 0
                    or vector_of(scene, MATERIAL_EMISSION, material)[0] > 0.0
                )
            if not glows and distance_to_triangle(scene, origin, direction, left - spheres, triangle) < end:
                return True
    return False


@fault("SHAD-3", "is_occluded", "Which kinds of objects does your shadow ray look at?")
def triangles_throw_no_shadow(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """Shadow rays look for spheres only."""
    if SPHERES:
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            if distance_to_sphere(scene, origin, direction, left, sphere) < end:
                return True
    return False


@fault("SHAD-4", "departure", "Where does rounding put the start of the ray: before or behind the surface?")
def shadow_acne(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """Rays start on the surface itself without any offset, and half of them meet it at once."""
    return point, NOTHING


@fault("SHAD-4", "departure", "How far from the surface does your ray start, in units of the smallest object?")
def epsilon_too_large(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """Rays start 0.05 above the surface, so shadows come loose from what throws them."""
    return along(point, normal, 0.05), NOTHING


@fault("SHAD-4", "departure", "Which way is out?")
def epsilon_to_the_wrong_side(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:
    """The small offset has the wrong sign, so rays start below the surface."""
    return along(point, normal, -1e-4), NOTHING


@fault("SHAD-4", "is_occluded", "Can an object stand in its own light?")
def no_object_shadows_itself(scene: SceneData, origin: Vector, direction: Vector, left: int, end: Scalar) -> bool:
    """All of the object that a shadow ray starts on is left out, not only the point itself."""
    spheres = rows_of(scene, SPHERE_MATERIAL)
    own = material_of(scene, left)
    if SPHERES:
        for sphere in range(spheres):
            if sphere != left and distance_to_sphere(scene, origin, direction, left, sphere) < end:
                return True
    if TRIANGLES:
        for triangle in range(rows_of(scene, TRIANGLE_MATERIAL)):
            is_own = left >= spheres and material_of(scene, spheres + triangle) == own
            if not is_own and distance_to_triangle(scene, origin, direction, left - spheres, triangle) < end:
                return True
    return False


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


@fault("TRAV-5", "triangle_distance", "In which unit is your determinant, and when is it small?")
def fixed_determinant_threshold(origin: Vector, direction: Vector, a: Vector, b: Vector, c: Vector) -> Scalar:
    """A determinant below 0.0001 counts as parallel, so small triangles vanish."""
    p = cross(direction, subtract(c, a))
    determinant = dot(subtract(b, a), p)
    if abs(determinant) < 1e-4:
        return inf
    u = dot(subtract(origin, a), p) / determinant
    q = cross(subtract(origin, a), subtract(b, a))
    v = dot(direction, q) / determinant
    if u < 0.0 or v < 0.0 or u + v > 1.0:
        return inf
    t = dot(subtract(c, a), q) / determinant
    return t if t > 0.0 else inf
