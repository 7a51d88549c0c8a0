"""What POV-Ray 3.7 can express of a scene."""

from __future__ import annotations

from collections import Counter
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.exporters.povray_materials import polynomial_falloff
from raytruth.scenes.extent import extent_of
from raytruth.scenes.features import BACKGROUNDS, FURTHER_RAYS, GEOMETRY, LIGHTS, LOCAL_TERMS, Feature, missing_features
from raytruth.scenes.media import relative_index
from raytruth.scenes.requirements import required_features
from raytruth.scenes.shapes import Mesh, Plane, Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator
    from collections.abc import Set as AbstractSet

    from numpy.typing import NDArray

    from raytruth.scenes.materials import Dielectric
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape

EXPRESSES = GEOMETRY | {Feature.PLANES} | BACKGROUNDS | LIGHTS | LOCAL_TERMS | FURTHER_RAYS
LARGEST_UNIT = 1024
"""POV-Ray's units in a unit of the scene, at most."""
# POV-Ray meets nothing farther than this (MAX_DISTANCE in source/backend/configbackend.h of version 3.7.0.10).
FARTHEST = 1e7
# Its colours are float32, whose roundings the error model counts for this many reflections and refractions.
DEEPEST = 12


def refuses(scene: Scene) -> str | None:
    """Why POV-Ray cannot express this scene, in one clause that follows 'because'; None if it can."""
    if scene.max_depth > DEEPEST:
        return f"POV-Ray computes colours in float32, whose roundings are bounded for {DEEPEST} bounces"
    reach = extent_of(scene)
    if reach > FARTHEST:
        return f"POV-Ray meets nothing that is farther than {FARTHEST:.0e} units away, and rays may go {reach:.2g} here"
    if len(scene.lights) > 1 and any(polynomial_falloff(light) for light in scene.lights):
        return "lights of POV-Ray lack this polynomial attenuation, and a filter in its place would dim others, too"
    required = required_features(scene)
    return _refuses_media(scene, required) or missing_features("POV-Ray", EXPRESSES, required)


def unit_of(scene: Scene) -> int:
    """POV-Ray's units in a unit of the scene, at least 1.

    A power of two, which rounds nothing, as large as POV-Ray's farthest distance allows: what it ignores near the start
    of a ray is then as near as can be.
    """
    unit = LARGEST_UNIT
    while unit > 1 and extent_of(scene) * unit > FARTHEST:
        unit //= 2
    return unit


def _refuses_media(scene: Scene, required: AbstractSet[Feature]) -> str | None:
    """Where no ray is refracted, the camera's medium shows all the same if it absorbs."""
    shapes = [shape for shape in scene.objects if scene.materials[shape.material].dielectric]
    if scene.max_depth:
        return _refuses_dielectrics(scene, shapes)
    return _refuses_camera(scene, shapes) if Feature.ABSORPTION in required else None


def _refuses_dielectrics(scene: Scene, shapes: list[Shape]) -> str | None:
    """POV-Ray knows a ray's medium from the surfaces it has passed, and ours from the surface that it meets."""
    for shape in shapes:
        reason = _refuses_dielectric(scene, _dielectric_of(scene, shape)) or _refuses_shape(shape)
        if reason:
            return reason
    return _refuses_overlaps(scene, shapes) or _refuses_camera(scene, shapes)


def _refuses_overlaps(scene: Scene, shapes: list[Shape]) -> str | None:
    """A dielectric may be wholly inside one other, in whose medium it is declared to be."""
    boxes = [_box(shape) for shape in shapes]
    around: dict[int, Shape] = {}
    for i, j in combinations(range(len(shapes)), 2):
        if not _may_overlap(shapes[i], boxes[i], shapes[j], boxes[j]):
            continue
        inner, outer = (i, j) if _is_inside(shapes[i], shapes[j]) else (j, i)
        if not _is_inside(shapes[inner], shapes[outer]) or inner in around:
            return "two dielectric objects may overlap, and POV-Ray takes the medium from what a ray has passed before"
        around[inner] = shapes[outer]
    for number, shape in enumerate(shapes):
        outside = around[number].material if number in around else None
        if outside != _dielectric_of(scene, shape).outside:
            return "a dielectric's outside is not the object around it, from which POV-Ray takes the medium"
        if number in around:
            beyond = _dielectric_of(scene, around[number])
            if beyond.reflectance is not None or (beyond.absorption and any(beyond.absorption)):
                return "POV-Ray lets the medium of an object absorb inside what is inside of it, too"
    return None


def _dielectric_of(scene: Scene, shape: Shape) -> Dielectric:
    """The dielectric of a shape which is known to have one."""
    dielectric = scene.materials[shape.material].dielectric
    assert dielectric is not None
    return dielectric


def _refuses_dielectric(scene: Scene, dielectric: Dielectric) -> str | None:
    if relative_index(scene, dielectric) == 1.0:
        return "POV-Ray does not count a surface between equal indices as a refraction"
    if dielectric.reflectance is not None:
        if relative_index(scene, dielectric) < 1.0:
            return (
                "POV-Ray reflects all where a ray is totally reflected from outside, whatever the constant weights say"
            )
        if min(dielectric.reflectance) == 0.0:
            return "POV-Ray weights total reflection like what comes through, which a weight of 0 would hide as well"
    return None


def _refuses_shape(shape: Shape) -> str | None:
    """Only what has an inside can have a medium."""
    if isinstance(shape, Sphere | Plane):
        return None
    if not isinstance(shape, Mesh) or not _is_closed(shape):
        return "a dielectric is not a closed mesh, and POV-Ray takes the medium from what a ray has passed before"
    corners = np.array(shape.vertices)[np.array(shape.faces)]
    if np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() <= 0:
        return "the normals of a dielectric point inward, and POV-Ray takes a ray that meets it first to enter it"
    return None


def _is_closed(mesh: Mesh) -> bool:
    """Whether each edge belongs to two faces that run along it in opposite directions, by the coordinates."""
    edges = Counter(
        (mesh.vertices[a], mesh.vertices[b])
        for face in mesh.faces
        for a, b in zip(face, (*face[1:], face[0]), strict=True)
    )
    return all(count == 1 and edges[(b, a)] == 1 for (a, b), count in edges.items())


def _box(shape: Shape) -> NDArray[np.float64]:
    """Lowest and highest corner, shape (2, 3); an infinite plane is everywhere."""
    if isinstance(shape, Plane):
        return np.array([[-np.inf] * 3, [np.inf] * 3])
    if isinstance(shape, Sphere):
        return np.array([np.array(shape.center) - shape.radius, np.array(shape.center) + shape.radius])
    points = np.array(shape.vertices)
    return np.array([points.min(axis=0), points.max(axis=0)])


def _may_overlap(first: Shape, first_box: NDArray[np.float64], second: Shape, second_box: NDArray[np.float64]) -> bool:
    if isinstance(first, Sphere) and isinstance(second, Sphere):
        distance = np.linalg.norm(np.subtract(first.center, second.center))
        return bool(distance <= first.radius + second.radius)
    return bool((first_box[0] <= second_box[1]).all() and (second_box[0] <= first_box[1]).all())


def _is_inside(inner: Shape, outer: Shape) -> bool:
    """Whether one surely holds the other; known of spheres only."""
    if not (isinstance(inner, Sphere) and isinstance(outer, Sphere)):
        return False
    distance = np.linalg.norm(np.subtract(inner.center, outer.center))
    return bool(distance + inner.radius < outer.radius)


def _refuses_camera(scene: Scene, shapes: list[Shape]) -> str | None:
    """The camera must be inside just the one object whose medium it is in."""
    camera = scene.camera
    if camera.projection == "orthographic":
        if camera.inside is not None or (shapes and any(_meets_plane(scene, shape) for shape in scene.objects)):
            return "POV-Ray's parallel rays may start in different media"
        return None
    holding = [shape for shape in _around_camera(scene) if scene.materials[shape.material].dielectric]
    if camera.inside is None:
        return "the camera may be inside an object, where POV-Ray would take its medium" if holding else None
    if [shape.material for shape in holding] != [camera.inside]:
        return "the camera's medium is not that of the object around it, from which POV-Ray takes it"
    return None


def _around_camera(scene: Scene) -> Iterator[Shape]:
    """Objects that the camera is or may be inside of."""
    position = np.array(scene.camera.position)
    for shape in scene.objects:
        if isinstance(shape, Sphere):
            if np.linalg.norm(position - shape.center) <= shape.radius:
                yield shape
        elif isinstance(shape, Plane):
            if np.subtract(position, shape.point) @ np.array(shape.normal) <= 0.0:
                yield shape
        elif isinstance(shape, Mesh):
            low, high = _box(shape)
            if (low <= position).all() and (position <= high).all():
                yield shape


def _meets_plane(scene: Scene, shape: Shape) -> bool:
    """Whether the plane in which parallel rays start may cut the object; nothing is known of infinite planes."""
    if isinstance(shape, Plane):
        return True
    forward = np.subtract(scene.camera.look_at, scene.camera.position)
    low, high = _box(shape)
    heights = [
        float(np.dot(np.where(np.array(corner), high, low) - scene.camera.position, forward))
        for corner in np.ndindex(2, 2, 2)
    ]
    return min(heights) <= 0.0 <= max(heights)
