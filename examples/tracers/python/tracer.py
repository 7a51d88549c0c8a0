"""A Whitted ray tracer, written to raytruth's docs/spec.md, whose clauses are named beside the lines they belong to.

python3 tracer.py SCENE.json OUTPUT.pfm                         # the picture
python3 tracer.py SCENE.json OUTPUT.pfm --trace COLUMN ROW      # the rays of one pixel, for `raytruth trace`
"""

from __future__ import annotations

import json
import sys
from array import array
from dataclasses import dataclass
from math import exp, inf, pi, sqrt
from pathlib import Path
from typing import TYPE_CHECKING

from scene import BLACK, Camera, Light, Material, Plane, Scene, Sphere, Triangle, load, may_meet
from vectors import Vec, add, cross, dot, length, multiply, scale, subtract, unit

if TYPE_CHECKING:
    from collections.abc import Iterator

Primitive = Sphere | Triangle | Plane

TRACED = sys.argv[3:]
"""--trace COLUMN ROW, or nothing."""


@dataclass(slots=True)
class Ray:
    """A half-line in a unit direction, and the primitive on whose surface it starts, if it starts on one."""

    origin: Vec
    direction: Vec
    leaves: Primitive | None = None
    path: str = ""  # which mirrors (M), reflections (R) and refractions (T) of glass it has come by


def meet_sphere(ray: Ray, sphere: Sphere) -> float:
    """The distance to the sphere, or infinity. Textbook quadratic: t² + 2bt + c = 0."""
    from_center = subtract(ray.origin, sphere.center)
    b = dot(ray.direction, from_center)
    if ray.leaves is sphere:
        return -2 * b if b < 0 else inf  # SPH-4
    discriminant = b * b - (dot(from_center, from_center) - sphere.radius * sphere.radius)
    if discriminant < 0:
        return inf  # SPH-2
    root = sqrt(discriminant)
    if -b - root > 0:
        return -b - root  # SPH-1
    return -b + root if -b + root > 0 else inf


def meet_triangle(ray: Ray, triangle: Triangle) -> float:
    """The distance to the triangle, or infinity (Möller and Trumbore 1997). TRI-1 to TRI-3."""
    p = cross(ray.direction, triangle.ac)
    determinant = dot(triangle.ab, p)
    if determinant == 0 or ray.leaves is triangle:
        return inf
    s = subtract(ray.origin, triangle.a)
    u = dot(s, p) / determinant
    if u < 0 or u > 1:
        return inf
    q = cross(s, triangle.ab)
    v = dot(ray.direction, q) / determinant
    if v < 0 or u + v > 1:
        return inf
    distance = dot(triangle.ac, q) / determinant
    return distance if distance > 0 else inf


def meet_plane(ray: Ray, plane: Plane) -> float:
    """The distance to the plane, or infinity. PLANE-1 to PLANE-3."""
    along = dot(ray.direction, plane.normal)
    if along == 0 or ray.leaves is plane:
        return inf
    distance = dot(subtract(plane.point, ray.origin), plane.normal) / along
    return distance if distance > 0 else inf


def hits(scene: Scene, ray: Ray) -> Iterator[tuple[float, Primitive]]:
    """The distances to all primitives in their order (TRAV-2), but to triangles that the ray surely misses."""
    for sphere in scene.spheres:
        yield meet_sphere(ray, sphere), sphere
    for cluster in scene.clusters:
        if may_meet(ray.origin, ray.direction, cluster):
            for triangle in cluster.triangles:
                yield meet_triangle(ray, triangle), triangle
    for plane in scene.planes:
        yield meet_plane(ray, plane), plane


def first_hit(scene: Scene, ray: Ray) -> tuple[float, Primitive | None]:
    """The nearest hit: its distance and its primitive. TRAV-1, TRAV-3: of equals the first stays."""
    nearest, hit = inf, None
    for distance, primitive in hits(scene, ray):
        if distance < nearest:
            nearest, hit = distance, primitive
    return nearest, hit


def is_hidden(scene: Scene, ray: Ray, light_distance: float) -> bool:
    """Whether anything lies between the ray's start and the light. SHAD-1 to SHAD-4."""
    return any(distance < light_distance for distance, _ in hits(scene, ray))


def background(scene: Scene, direction: Vec) -> Vec:
    """What a ray brings that meets nothing. BG-1."""
    k = (direction[1] + 1) / 2
    return add(scale(1 - k, scene.bottom), scale(k, scene.top))


def attenuation(light: Light, distance: float) -> float:
    """How a point light weakens with distance: ILL-7, and 1/d² of ILL-3."""
    constant, linear, quadratic = light.falloff
    divisor = constant + linear * distance + quadratic * distance * distance
    return 1 if light.is_clamped and divisor <= 1 else 1 / divisor


def lit_by(scene: Scene, light: Light, ray: Ray, reflected: Ray, normal: Vec, material: Material) -> Vec:
    """What one light adds where the ray hits and `reflected` starts. The normal is turned to the ray's origin."""
    point = reflected.origin
    if light.position is None:
        distance, strength, to_light = inf, 1.0, scale(-1, light.direction)
    else:
        way = subtract(light.position, point)
        distance = length(way)
        if distance == 0:
            return BLACK  # ILL-9
        strength, to_light = attenuation(light, distance), scale(1 / distance, way)
    cosine = dot(normal, to_light)
    if cosine <= 0 or is_hidden(scene, Ray(point, to_light, reflected.leaves), distance):
        return BLACK  # ILL-2
    weight = BLACK
    if material.diffuse is not None:  # ILL-2, ILL-3
        weight = scale(cosine / pi if scene.is_radiometric else cosine, material.diffuse(point))
    if material.specular is not None:
        if material.is_blinn:
            highlight = dot(normal, unit(subtract(to_light, ray.direction)))  # ILL-6
        else:
            highlight = dot(reflected.direction, to_light)  # ILL-5
        weight = add(weight, scale(max(highlight, 0) ** material.exponent, material.specular))
    return scale(strength, multiply(weight, light.intensity))


def radiance(scene: Scene, ray: Ray, medium: Material | None, depth: int) -> Vec:
    """The light that comes back along a ray which has `depth` reflections and refractions left. TREE."""
    distance, primitive = first_hit(scene, ray)
    if primitive is None:
        seen = background(scene, ray.direction)  # BG-3: not absorbed
        note(scene, ray, None, local=seen, color=seen)
        return seen
    point = add(ray.origin, scale(distance, ray.direction))
    is_sphere = isinstance(primitive, Sphere)
    normal = unit(subtract(point, primitive.center)) if is_sphere else primitive.normal  # SPH-5
    enters = dot(ray.direction, normal) < 0  # ILL-1
    if not enters:
        normal = scale(-1, normal)
    mirrored = subtract(ray.direction, scale(2 * dot(ray.direction, normal), normal))  # REFL-1
    reflected = Ray(point, mirrored, primitive)

    material = primitive.material
    total = BLACK
    if material.emission is not None:
        total = add(total, material.emission(point))
    if material.ambient is not None:
        total = add(total, multiply(material.ambient, scene.ambient_light))
    if material.diffuse is not None or material.specular is not None:
        for light in scene.lights:
            total = add(total, lit_by(scene, light, ray, reflected, normal, material))
    local = total
    if depth > 0 and material.mirror is not None:  # REFL-2
        reflected.path = ray.path + "M"
        total = add(total, multiply(material.mirror, radiance(scene, reflected, medium, depth - 1)))
    if depth > 0 and material.dielectric is not None:
        total = add(total, through(scene, ray, reflected, normal, enters, medium, depth))

    if medium is not None and medium.dielectric.absorption is not None:
        total = multiply(total, tuple(exp(-sigma * distance) for sigma in medium.dielectric.absorption))  # REFR-7
    note(scene, ray, primitive, distance=distance, normal=normal, local=local, color=total)
    return total


def through(
    scene: Scene, ray: Ray, reflected: Ray, normal: Vec, enters: bool, medium: Material | None, depth: int
) -> Vec:
    """What a dielectric reflects and refracts. The normal is turned to the ray's origin. REFR."""
    material = reflected.leaves.material
    glass = material.dielectric
    outer = glass.outside.dielectric.index if glass.outside else 1.0
    eta = glass.index / outer if enters else outer / glass.index  # REFR-1
    c = -dot(ray.direction, normal)
    g_squared = eta * eta - 1 + c * c  # REFR-2
    reflected.path = ray.path + "R"
    mirrored = radiance(scene, reflected, medium, depth - 1)
    if g_squared < 0:
        return multiply(glass.reflectance, mirrored) if glass.reflectance else mirrored  # REFR-5, REFR-6
    g = sqrt(g_squared)
    fresnel = 1.0
    if c > 0:  # REFR-4
        fresnel = (((c - g) / (c + g)) ** 2 + ((eta * eta * c - g) / (eta * eta * c + g)) ** 2) / 2
    transmitted = (1 - fresnel) / (eta * eta) if scene.is_radiometric else 1 - fresnel
    reflectance = glass.reflectance or (fresnel,) * 3  # REFR-6
    transmittance = glass.transmittance or (transmitted,) * 3
    refracted = scale(1 / eta, add(ray.direction, scale(c - g, normal)))  # REFR-3
    beyond = material if enters else glass.outside  # REFR-9
    behind = radiance(scene, Ray(reflected.origin, refracted, reflected.leaves, ray.path + "T"), beyond, depth - 1)
    return add(multiply(reflectance, mirrored), multiply(transmittance, behind))


def note(scene: Scene, ray: Ray, primitive: Primitive | None, **told: object) -> None:
    """Print a ray and what came of it as a line of JSON, if the rays of a pixel are asked for."""
    if not TRACED:
        return
    triangles = (triangle for cluster in scene.clusters for triangle in cluster.triangles)
    numbers = {id(shape): number for number, shape in enumerate([*scene.spheres, *triangles, *scene.planes])}
    hit = None if primitive is None else numbers[id(primitive)]
    told = {"path": ray.path, "origin": ray.origin, "direction": ray.direction, "primitive": hit, **told}
    print(json.dumps(told))


def camera_ray(camera: Camera, column: int, row: int) -> Ray:
    """The ray through the centre of a pixel. CAM-3, CAM-4, IMG-1."""
    x = (column + 0.5 - camera.width / 2) * camera.pixel
    y = (row + 0.5 - camera.height / 2) * camera.pixel
    across = add(scale(x, camera.right), scale(y, camera.down))
    if camera.is_perspective:
        return Ray(camera.position, unit(add(camera.forward, across)))
    return Ray(add(camera.position, across), camera.forward)


def main(scene_file: str, output: str) -> None:
    """Render the scene and write it as a PFM, whose first row is the bottom one."""
    scene = load(Path(scene_file))
    camera = scene.camera
    if TRACED:
        radiance(scene, camera_ray(camera, int(TRACED[1]), int(TRACED[2])), camera.inside, scene.max_depth)
        return
    values: list[float] = []
    for row in reversed(range(camera.height)):
        for column in range(camera.width):
            values += radiance(scene, camera_ray(camera, column, row), camera.inside, scene.max_depth)
    byte_order = -1.0 if sys.byteorder == "little" else 1.0
    header = f"PF\n{camera.width} {camera.height}\n{byte_order}\n"
    Path(output).write_bytes(header.encode("ascii") + array("f", values).tobytes())


if __name__ == "__main__":
    if len(sys.argv) != 3 and (len(sys.argv) != 6 or sys.argv[3] != "--trace"):
        sys.exit("usage: tracer.py SCENE.json OUTPUT.pfm [--trace COLUMN ROW]")
    main(sys.argv[1], sys.argv[2])
