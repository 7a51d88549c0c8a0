"""What Cycles can express of a scene, through Blender 5.0."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.exporters.triangle_soup import triangles_of
from raytruth.scenes.features import BACKGROUNDS, GEOMETRY, RADIOMETRIC_LIGHTS, Feature, missing_features
from raytruth.scenes.lights import PointLight
from raytruth.scenes.materials import colors_of
from raytruth.scenes.media import relative_index
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.requirements import required_features
from raytruth.scenes.shapes import Mesh, Plane, Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape, Triangle

EXPRESSES = (
    GEOMETRY
    | BACKGROUNDS
    | RADIOMETRIC_LIGHTS
    | {Feature.CHECKERBOARD, Feature.EMISSION, Feature.DIFFUSE, Feature.MIRRORS, Feature.DIELECTRICS}
)
# Of the socket IOR of Blender's glass.
LARGEST_INDEX = 1000.0
# A term is left out whose colour's mean is under 1e-5 (CLOSURE_WEIGHT_CUTOFF in src/kernel/types.h, used by bsdf_alloc
# in src/kernel/closure/alloc.h); the mean is computed in float32.
FAINTEST_COLOR = 1e-5 * (1 + 2.0**-20)
# The sensor's half height over the focal length: 50 over 1, the least that Blender has (cycles_worker.SENSOR_HEIGHT).
WIDEST_TANGENT = 50.0
# Where a camera's rays start, along its axis: the least that Blender has (clip_start).
NEAR_PLANE = 1e-6
# Of a picture of Blender (resolution_x and resolution_y).
SMALLEST_SIDE = 4
UNSCALED = "Cycles does not scale radiance on refraction, which cancels only for paths that begin and end outside"


def refuses(scene: Scene) -> str | None:
    """Why Cycles cannot express this scene, in one clause that follows 'because'; None if it can."""
    without_planes = refuses_planes("Cycles", scene)
    if without_planes:
        return without_planes
    for light in scene.lights:
        if isinstance(light, PointLight) and light.falloff != "inverse_square":
            return "a point light of Cycles falls off with the inverse square of the distance and in no other way"
    required = required_features(scene)
    if Feature.ABSORPTION in required:  # of a medium that no object needs to be made of, too
        return "Cycles scatters and absorbs in volumes at random places, of which no bound is known"
    for name in sorted({shape.material for shape in scene.objects}):
        reason = _refuses_material(scene, scene.materials[name])
        if reason:
            return reason
    reason = _refuses_camera(scene) or _refuses_spheres(scene) or _refuses_glass(scene)
    return reason or missing_features("Cycles", EXPRESSES, required)


def _refuses_material(scene: Scene, material: Material) -> str | None:
    """Terms that Cycles lacks, alone or together."""
    whitted = scene.convention == "whitted"
    colors = list(_colors(material))
    reflectances = list(_reflectances(material))
    glass = material.dielectric
    reasons = {
        "Cycles has no ambient light": material.ambient and any(scene.ambient_light),
        "Cycles has neither Phong's nor Blinn's specular term in its classical form": material.specular,
        "Cycles divides a diffuse reflectance by π, and the whitted convention does not": whitted and material.diffuse,
        "a dielectric of Cycles obeys Fresnel's equations and has no constant weights": glass and glass.reflectance,
        "Cycles goes on at random from a surface that has several of a diffuse, a mirror and a dielectric term": [
            material.diffuse,
            material.mirror,
            glass,
        ].count(None)
        < 2,
        "a reflectance of Cycles is at most 1": any(max(color) > 1 for color in reflectances),
        "Cycles leaves out terms whose colour is fainter than 1e-5": any(
            0 < sum(color) / 3 < FAINTEST_COLOR for color in colors
        ),
        f"an index of refraction of Cycles is at most {LARGEST_INDEX:g}": glass
        and relative_index(scene, glass) > LARGEST_INDEX,
    }
    return next((reason for reason, holds in reasons.items() if holds), None)


def _reflectances(material: Material) -> Iterator[tuple[float, ...]]:
    if material.mirror:
        yield material.mirror.reflectance
    if material.diffuse:
        yield from colors_of(material.diffuse.reflectance)


def _colors(material: Material) -> Iterator[tuple[float, ...]]:
    yield from _reflectances(material)
    if material.emission:
        yield from colors_of(material.emission.radiance)


def _refuses_camera(scene: Scene) -> str | None:
    camera = scene.camera
    if min(camera.width, camera.height) < SMALLEST_SIDE:
        return f"a picture of Blender has {SMALLEST_SIDE} pixels a side at least"
    if camera.inside is not None and scene.convention == "radiometric":
        return UNSCALED
    if camera.projection == "perspective":
        tangent = np.tan(np.radians(camera.vertical_field_of_view / 2))
        if tangent > WIDEST_TANGENT:
            return "a camera of Blender has a focal length of 1 mm at least, which is too long for so wide a view"
    if any(_is_before_near_plane(scene, shape) for shape in scene.objects):
        return f"a camera of Blender sees nothing that is nearer than {NEAR_PLANE:g}"
    return None


def _is_before_near_plane(scene: Scene, shape: Shape) -> bool:
    """Whether any part of it may be in front of the camera and before its near plane, where it is seen."""
    camera = scene.camera
    forward = np.subtract(camera.look_at, camera.position)
    forward = forward / np.linalg.norm(forward)
    if isinstance(shape, Sphere):
        to_center = np.subtract(shape.center, camera.position)
        distance = np.linalg.norm(to_center) if camera.projection == "perspective" else abs(to_center @ forward)
        return bool(0 <= distance - shape.radius <= _near_reach(scene))
    corners = triangles_of(shape) - camera.position
    depths = corners @ forward
    crosses = (depths.min(axis=1) < NEAR_PLANE) & (depths.max(axis=1) > 0)
    if camera.projection == "perspective":
        # No part of a triangle is nearer than its plane and than its box.
        reach = _near_reach(scene)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        heights = np.abs(np.einsum("ij,ij->i", normals, corners[:, 0]))
        crosses &= heights <= reach * np.linalg.norm(normals, axis=1)
        crosses &= ((corners.min(axis=1) <= reach) & (corners.max(axis=1) >= -reach)).all(axis=1)
    return bool(crosses.any())


def _near_reach(scene: Scene) -> float:
    """The largest distance from the camera at which a ray starts."""
    camera = scene.camera
    if camera.projection != "perspective":
        return NEAR_PLANE
    tangent = np.tan(np.radians(camera.vertical_field_of_view / 2))
    return float(NEAR_PLANE * np.sqrt(1 + tangent**2 * (1 + (camera.width / camera.height) ** 2)))


def _refuses_spheres(scene: Scene) -> str | None:
    """A sphere is a point of Cycles: a ray that starts on one leaves it out, and is not stopped by one from inside.

    A ray that starts outside of all spheres ends outside of all: so the camera decides.
    """
    for shape in scene.objects:
        if not isinstance(shape, Sphere):
            continue
        if scene.materials[shape.material].dielectric:
            return "a ray that starts on a sphere of Cycles never meets it again, so that none leaves a sphere of glass"
        if _camera_is_inside(scene, shape):
            return "a sphere of Cycles is met from outside only, and here the camera is inside of one"
    return None


def _camera_is_inside(scene: Scene, sphere: Sphere) -> bool:
    """Whether a camera's ray may start inside; those of parallel rays start anywhere in the camera's plane."""
    camera = scene.camera
    to_center = np.subtract(sphere.center, camera.position)
    if camera.projection == "perspective":
        return bool(np.linalg.norm(to_center) <= sphere.radius)
    forward = np.subtract(camera.look_at, camera.position)
    return bool(abs(to_center @ forward) <= sphere.radius * np.linalg.norm(forward))


def _refuses_glass(scene: Scene) -> str | None:
    """Whether a path may end in glass: where all of it is closed, and nothing but glass may be inside, none does.

    In the whitted convention radiance is not scaled, as in Cycles.
    """
    if scene.convention == "whitted":
        return None
    glass = [shape for shape in scene.objects if scene.materials[shape.material].dielectric]
    others = [shape for shape in scene.objects if not scene.materials[shape.material].dielectric]
    for shape in glass:
        dielectric = scene.materials[shape.material].dielectric
        assert dielectric is not None  # it is glass
        assert not isinstance(shape, Sphere | Plane)  # refused before
        if dielectric.outside is not None or not _is_closed(shape):
            return UNSCALED
        if any(_boxes_overlap(_box(shape), _box(other)) for other in others):
            return UNSCALED
    return None


def _is_closed(shape: Mesh | Triangle) -> bool:
    """Whether at each edge the triangle on one side meets one on the other, with normals on the same side."""
    if not isinstance(shape, Mesh):
        return False
    corners = [[shape.vertices[vertex] for vertex in face] for face in shape.faces]
    edges = Counter((face[i], face[(i + 1) % 3]) for face in corners for i in range(3))
    return all(count == 1 and edges[end, start] == 1 for (start, end), count in list(edges.items()))


def _box(shape: Shape) -> NDArray[np.float64]:
    """The lowest and the highest coordinates, shape (2, 3)."""
    if isinstance(shape, Sphere):
        return np.array([np.subtract(shape.center, shape.radius), np.add(shape.center, shape.radius)])
    assert not isinstance(shape, Plane)  # refused before
    corners = np.array(shape.vertices)
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def _boxes_overlap(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    return bool((first[0] <= second[1]).all() and (second[0] <= first[1]).all())
