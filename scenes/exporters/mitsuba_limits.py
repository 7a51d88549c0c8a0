"""What Mitsuba 3 can express of a scene, and which side of its emissive surfaces must shine."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.camera import OrthographicCamera
from raytruth.scenes.exporters.triangle_soup import triangles_of
from raytruth.scenes.features import BACKGROUNDS, GEOMETRY, RADIOMETRIC_LIGHTS, Feature, missing_features
from raytruth.scenes.lights import PointLight
from raytruth.scenes.materials import CheckerboardColor, colors_of
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.requirements import required_features
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape

# Mitsuba keeps coordinates in float32: what lies closer to a plane than half an ulp of them is on it.
FLOAT32_ROUNDOFF = 2.0**-24
EXPRESSES = (
    GEOMETRY
    | BACKGROUNDS
    | RADIOMETRIC_LIGHTS
    | {Feature.CHECKERBOARD, Feature.EMISSION, Feature.DIFFUSE, Feature.MIRRORS, Feature.DIELECTRICS}
)
NO_ABSORPTION = "Mitsuba's direct and path integrators have no absorbing media"


def refuses(scene: Scene) -> str | None:
    """Why Mitsuba cannot express this scene, in one clause that follows 'because'; None if it can."""
    without_planes = refuses_planes("Mitsuba", scene)
    if without_planes:
        return without_planes
    for light in scene.lights:
        if isinstance(light, PointLight) and light.falloff != "inverse_square":
            return "a point light of Mitsuba falls off with the inverse square of the distance and in no other way"
    required = required_features(scene)
    if Feature.ABSORPTION in required:  # of a medium that no object needs to be made of, too
        return NO_ABSORPTION
    for name in sorted({shape.material for shape in scene.objects}):
        material = scene.materials[name]
        reason = _refuses_material(scene, material) or _refuses_textures(scene, name, material)
        if reason:
            return reason
    return _refuses_emission(scene) or missing_features("Mitsuba", EXPRESSES, required)


def _refuses_material(scene: Scene, material: Material) -> str | None:
    """Terms that Mitsuba lacks, alone or together."""
    whitted = scene.convention == "whitted"
    reasons = {
        "Mitsuba has no ambient light": material.ambient and any(scene.ambient_light),
        "Mitsuba has neither Phong's nor Blinn's specular term in its classical form": material.specular,
        "Mitsuba divides a diffuse reflectance by π, and the whitted convention does not": whitted and material.diffuse,
        "Mitsuba scales radiance on refraction, and the whitted convention does not": whitted and material.dielectric,
        "a dielectric of Mitsuba has no diffuse, mirror or emissive term beside it": material.dielectric
        and (material.diffuse or material.mirror or material.emission),
        "Mitsuba blends a diffuse and a mirror term at random, with weights that add up to 1": material.diffuse
        and material.mirror,
        "a reflectance of Mitsuba is at most 1": _largest_reflectance(material) > 1,
        "a dielectric of Mitsuba obeys Fresnel's equations and has no constant weights": material.dielectric
        and material.dielectric.reflectance is not None,
        NO_ABSORPTION: material.dielectric and any(material.dielectric.absorption or ()),
    }
    return next((reason for reason, holds in reasons.items() if holds), None)


def _largest_reflectance(material: Material) -> float:
    textures = [term.reflectance for term in (material.mirror, material.diffuse) if term]
    return max((max(color) for texture in textures for color in colors_of(texture)), default=0.0)


def _refuses_textures(scene: Scene, name: str, material: Material) -> str | None:
    diffuse = material.diffuse.reflectance if material.diffuse else None
    radiance = material.emission.radiance if material.emission else None
    boards = [texture.checkerboard for texture in (diffuse, radiance) if isinstance(texture, CheckerboardColor)]
    if boards and any(isinstance(shape, Sphere) and shape.material == name for shape in scene.objects):
        return "Mitsuba wraps a texture around a sphere by angles and cannot cut it from a plane"
    if len({(board.size, board.plane, board.offset) for board in boards}) > 1:
        return "a shape of Mitsuba has one set of texture coordinates, and here two checkerboards differ in theirs"
    return None


def _refuses_emission(scene: Scene) -> str | None:
    """Our emission shines on both sides; an area light of Mitsuba on one, and copies back to back would fight."""
    specular_points, specular_radii = _specular_extent(scene)
    for shape in scene.objects:
        if scene.materials[shape.material].emission is None or isinstance(shape, Sphere):
            continue
        for triangle in triangles_of(shape):
            if len(_sides_seen(scene, triangle, specular_points, specular_radii)) > 1:
                return "an area light of Mitsuba shines on one side, and here both sides of one can be seen"
    return None


def reversed_primitives(scene: Scene) -> NDArray[np.bool_]:
    """Which primitives must face the other way in Mitsuba for their seen side to shine; in our numbering of them.

    Only emissive ones. A sphere is opaque, so that all rays see the side on which the camera is.
    """
    specular_points, specular_radii = _specular_extent(scene)
    spheres = [shape for shape in scene.objects if isinstance(shape, Sphere)]
    reverse = [_is_emissive(scene, sphere) and _camera_is_inside(scene, sphere) for sphere in spheres]
    for shape in scene.objects:
        if isinstance(shape, Sphere):
            continue
        for triangle in triangles_of(shape):
            emissive = _is_emissive(scene, shape)
            reverse.append(emissive and _sides_seen(scene, triangle, specular_points, specular_radii) == {-1})
    return np.array(reverse, dtype=bool)


def _is_emissive(scene: Scene, shape: Shape) -> bool:
    return scene.materials[shape.material].emission is not None


def _camera_is_inside(scene: Scene, sphere: Sphere) -> bool:
    return bool(np.linalg.norm(np.subtract(scene.camera.position, sphere.center)) < sphere.radius)


def _specular_extent(scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Balls from whose surfaces all mirrored and refracted rays start: spheres, and corners with radius 0.

    Diffuse surfaces do not count: what they receive from an emissive surface is in no light path of Whitted's.
    """
    points: list[NDArray[np.float64]] = [np.empty((0, 3))]
    radii: list[NDArray[np.float64]] = [np.empty(0)]
    for shape in scene.objects:
        material = scene.materials[shape.material]
        if "rays" not in material.light_from():
            continue
        if isinstance(shape, Sphere):
            points.append(np.array([shape.center], dtype=np.float64))
            radii.append(np.array([shape.radius], dtype=np.float64))
        else:
            corners = triangles_of(shape).reshape(-1, 3)
            points.append(corners)
            radii.append(np.zeros(len(corners)))
    return np.concatenate(points), np.concatenate(radii)


def _sides_seen(
    scene: Scene, triangle: NDArray[np.float64], points: NDArray[np.float64], radii: NDArray[np.float64]
) -> set[int]:
    """From which sides of a triangle (+1: where its normal points) the camera or a specular surface may see it."""
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    length = np.linalg.norm(normal)
    if length == 0:
        return set()
    normal = normal / length
    camera = scene.camera
    if isinstance(camera, OrthographicCamera):
        sides = {int(np.sign(np.dot(normal, np.subtract(camera.position, camera.look_at))))}
    else:
        sides = {int(np.sign(np.dot(normal, np.subtract(camera.position, triangle[0]))))}
    distances = (points - triangle[0]) @ normal
    largest = max(np.abs(triangle).max(), np.abs(points).max(initial=0.0))
    resolution = FLOAT32_ROUNDOFF * largest
    if np.any(distances + radii > resolution):
        sides.add(1)
    if np.any(distances - radii < -resolution):
        sides.add(-1)
    return sides - {0}
