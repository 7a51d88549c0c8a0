"""A bound on what one light path, traced forward from a point light, adds to a pixel.

A path that leaves a point light of intensity I in a direction chosen uniformly, meets a surface of reflectance ρ and is
connected with the camera gives the pixel behind which it arrives

    4·I·ρ · cos θ_s / (d² · cos³ θ · A)

where d is the distance from the camera, θ_s the angle at the surface between normal and way to the camera, θ that of
this way with the camera's axis, and A the pixel's area in an image plane at distance 1. It is the radiance
(ρ/π)·I·cos θ_l/r², times the share of the pixel that a unit of the surface's area fills, cos θ_s/(d²·cos³ θ·A), over
the density of the points that are met, cos θ_l/(4π·r²) (Veach, "Robust Monte Carlo Methods for Light Transport
Simulation", 1997, chapter 8). Neither the distance r from the light nor the angle θ_l there is left in it.
"""

from __future__ import annotations

from math import radians, tan
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.noise.pixel_areas import enlarged
from raytruth.reference_tracer.rendering import first_hits, prepare, primary_rays
from raytruth.reference_tracer.tables import triangles_of
from raytruth.scenes.lights import ConstantBackground, PointLight
from raytruth.scenes.materials import Diffuse, colors_of
from raytruth.scenes.planes import has_planes
from raytruth.scenes.requirements import used_materials
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene

    Array = NDArray[np.float64]

# Points along each side of a pixel at which splats are computed. The largest of a pixel and of all pixels around it is
# taken: on a plane splats change steadily, so that the points beyond a pixel's corners bound what lies within it.
GRID = 4


def has_splat_bound(scene: Scene) -> bool:
    """Whether a light path's splat has a bound: point lights, diffuse surfaces alone, and a perspective camera.

    Of infinite planes none is claimed, since nobody who sends light has them.
    """
    dark = isinstance(scene.background, ConstantBackground) and not any(scene.background.color)
    lights = all(isinstance(light, PointLight) and light.falloff == "inverse_square" for light in scene.lights)
    surfaces = all(_is_diffuse(material) for material in used_materials(scene))
    bounded = surfaces and not has_planes(scene)
    return dark and lights and bounded and scene.camera.projection == "perspective" and bool(scene.lights)


def largest_splats(scene: Scene) -> Array:
    """The most that one light path adds to each pixel's sum; shape (height, width, 3), 0 where nothing is seen.

    Of several lights one is taken for each path: with equal probability, or with one in proportion to its power; so a
    path counts as many times as there are lights, or fewer. Assumes `has_splat_bound`, and that no surface is seen by
    neither a pixel's points nor those of the pixels around it; of shapes, shape_widths.py tells.
    """
    fine = enlarged(scene, GRID)
    distances, primitives = first_hits(prepare(fine))
    _, directions = primary_rays(fine)
    seen = primitives >= 0
    reflectances, normals = np.zeros(directions.shape), np.zeros(directions.shape)
    reflectances[seen] = _reflectances(scene)[primitives[seen]]
    points = np.array(scene.camera.position) + np.where(seen, distances, 0.0)[..., np.newaxis] * directions
    normals[seen] = _normals(scene, points[seen], primitives[seen])
    at_surface = np.abs(np.sum(normals * directions, axis=2))
    axis = np.subtract(scene.camera.look_at, scene.camera.position)
    at_camera = directions @ (axis / np.linalg.norm(axis))
    per_area = np.where(seen, at_surface / (np.where(seen, distances, 1.0) ** 2 * at_camera**3), 0.0)
    splats = 4 * _largest_intensity(scene) * reflectances * (per_area / _pixel_area(scene))[..., np.newaxis]
    return _largest_around(splats)


def _is_diffuse(material: Material) -> bool:
    """Whether a material has a diffuse term and no other, known here or not."""
    return all(isinstance(term, Diffuse) for term in material.terms().values())


def _largest_intensity(scene: Scene) -> Array:
    intensities = [light.intensity for light in scene.lights if isinstance(light, PointLight)]
    largest: Array = len(intensities) * np.max(intensities, axis=0)
    return largest


def _pixel_area(scene: Scene) -> float:
    """The area of a pixel in an image plane at distance 1."""
    camera = scene.camera
    assert camera.projection == "perspective", "other cameras have no bound"
    return float(2 * tan(radians(camera.vertical_field_of_view) / 2) / camera.height) ** 2


def _reflectances(scene: Scene) -> Array:
    """The largest of each primitive, shape (primitives, 3)."""
    _, of_triangles = triangles_of(scene)
    names = [shape.material for shape in scene.objects if isinstance(shape, Sphere)] + of_triangles
    return np.array([_largest_reflectance(scene.materials[name]) for name in names])


def _largest_reflectance(material: Material) -> Array:
    if material.diffuse is None:
        return np.zeros(3)
    largest: Array = np.max(colors_of(material.diffuse.reflectance), axis=0)
    return largest


def _normals(scene: Scene, points: Array, primitives: NDArray[np.int64]) -> Array:
    """Unit normals at points on these primitives, to either side; shape (n, 3)."""
    spheres = [shape for shape in scene.objects if isinstance(shape, Sphere)]
    triangles, _ = triangles_of(scene)
    normals = np.zeros(points.shape)
    is_round = primitives < len(spheres)
    if is_round.any():
        normals[is_round] = points[is_round] - np.array([sphere.center for sphere in spheres])[primitives[is_round]]
    if not is_round.all():
        a, b, c = triangles.reshape(-1, 3, 3).transpose(1, 0, 2)
        normals[~is_round] = np.cross(b - a, c - a)[primitives[~is_round] - len(spheres)]
    unit: Array = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return unit


def _largest_around(splats: Array) -> Array:
    """The largest over each pixel and those around it."""
    height, width, channels = splats.shape
    pixels = splats.reshape(height // GRID, GRID, width // GRID, GRID, channels).max(axis=(1, 3))
    padded = np.pad(pixels, ((1, 1), (1, 1), (0, 0)))
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    largest: Array = windows.max(axis=(3, 4))
    return largest
