"""Light and materials as VTK has them, and why it has not those of a scene.

VTK's shader (vtkOpenGLPolyDataMapper.cxx, ReplaceShaderLight) sums what the classical equation does: ambient colour,
diffuse colour times N·L and specular colour times (R·V)^n of each light, on the side that is seen, times the light's
colour over a + b·d + c·d²; for N·L <= 0 nothing.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.rasterisers.drawn_pieces import ROUNDOFF
from raytruth.comparisons.error_models.rasterisers.rasterised_light import LEAST_COSINE
from raytruth.comparisons.renderers.vtk.job import Lamp, Surface, Vector
from raytruth.scenes.exporters.triangle_soup import material_of_each_triangle, triangles_of_scene
from raytruth.scenes.features import FURTHER_RAYS, LIGHTS, TRIANGLE_GEOMETRY, Feature, missing_features
from raytruth.scenes.hidden_lights import may_be_hidden
from raytruth.scenes.lights import GradientBackground, PointLight, PolynomialFalloff
from raytruth.scenes.requirements import required_features, used_materials

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.lights import Light
    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene

# It sends no further rays: where a scene needs them, its light paths tell.
EXPRESSES = (
    TRIANGLE_GEOMETRY
    | LIGHTS
    | FURTHER_RAYS
    | {Feature.BACKGROUND, Feature.EMISSION, Feature.AMBIENT, Feature.DIFFUSE, Feature.PHONG}
)
BLACK: Vector = (0.0, 0.0, 0.0)
# VTK's shader has each in a piece of its own; with 100 it was not compiled in a minute.
MOST_LIGHTS = 32
# vtkProperty::SetSpecularPower clamps it.
LARGEST_EXPONENT = 128.0
# A smaller one makes more than a roundoff of 1 of VTK's least cosine, which stands for all below and for 0.
LEAST_EXPONENT = math.log(ROUNDOFF) / math.log(LEAST_COSINE)


def refused_light(scene: Scene) -> str | None:
    """Why VTK's light is not the scene's, in one clause; None if it is. The scene is one of triangles."""
    if isinstance(scene.background, GradientBackground):
        return "its background changes with the ray, and VTK's with the place in the picture"
    if len(scene.lights) > MOST_LIGHTS:
        return (
            f"it has {len(scene.lights)} lights, and VTK's shader takes too long to compile for more than {MOST_LIGHTS}"
        )
    for material in used_materials(scene):
        refusal = _refused_material(material, scene)
        if refusal is not None:
            return refusal
    for number, light in enumerate(scene.lights):
        refusal = _refused_place(light, number, scene)
        if refusal is not None:
            return refusal
    hidden = may_be_hidden(scene)
    if hidden is not None:
        return f"VTK throws no shadows, and {hidden}"
    return missing_features("VTK", EXPRESSES, required_features(scene))


def _refused_material(material: Material, scene: Scene) -> str | None:
    if Feature.CHECKERBOARD in material.features():
        return "it has a checkerboard, and VTK's textures are pictures"
    if material.specular is None or not scene.lights:
        return None
    if material.specular.model != "phong":
        return "it has Blinn's highlights, and VTK's are Phong's"
    if scene.camera.projection == "orthographic":
        return "VTK takes highlights as seen from the camera's position, also where rays are parallel"
    if not LEAST_EXPONENT <= material.specular.exponent <= LARGEST_EXPONENT:
        return (
            f"VTK has highlights with exponents from {LEAST_EXPONENT:.3g}, below which its least cosine of "
            f"{LEAST_COSINE:g} shows, to {LARGEST_EXPONENT:g}"
        )
    return None


def _refused_place(light: Light, number: int, scene: Scene) -> str | None:
    if not isinstance(light, PointLight):
        return None
    nearest = _least_distance(scene, light)
    if nearest <= 0:
        return f"its light {number} may be in a surface that it lights, and VTK divides by the distance"
    falloff = light.falloff
    if isinstance(falloff, PolynomialFalloff) and (
        falloff.constant + nearest * (falloff.linear + nearest * falloff.quadratic) < 1
    ):
        return "it attenuates a light by no more than 1 however near it is, and VTK may brighten it there"
    return None


def _least_distance(scene: Scene, light: PointLight) -> float:
    """A lower bound on that of a lit triangle: from its box, or from its plane if that is farther."""
    names = material_of_each_triangle(scene)
    lit = ["lights" in scene.materials[name].light_from() for name in names]
    triangles = triangles_of_scene(scene)[lit]
    to_corners = triangles - np.array(light.position)
    to_box = np.maximum(np.maximum(to_corners.min(axis=1), -to_corners.max(axis=1)), 0.0)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    heights = np.abs((normals * to_corners[:, 0]).sum(axis=1)) / np.where(lengths > 0, lengths, np.inf)
    distances = np.maximum(np.linalg.norm(to_box, axis=1), heights)
    # A rounding of the corners' largest coordinate, amplified by no triangle that is not seen edge on all the same.
    return float(distances.min(initial=np.inf)) - 2.0**-40 * float(np.abs(to_corners).max(initial=0.0))


def surfaces_of(scene: Scene) -> tuple[tuple[Surface, ...], NDArray[np.int64]]:
    """A surface for each material, and the number of each triangle's, shape (n,)."""
    places = {name: place for place, name in enumerate(scene.materials)}
    numbers = [places[name] for name in material_of_each_triangle(scene)]
    surfaces = tuple(_surface(material, scene) for material in scene.materials.values())
    return surfaces, np.array(numbers, dtype=np.int64)


def _surface(material: Material, scene: Scene) -> Surface:
    emitted, reflected, diffuse = (np.zeros(3) for _ in range(3))
    if material.emission and isinstance(material.emission.radiance, tuple):
        emitted = np.array(material.emission.radiance)
    if material.ambient:
        reflected = np.multiply(material.ambient.reflectance, scene.ambient_light)
    # Without any light VTK shows the diffuse colour as it is.
    if material.diffuse and scene.lights and isinstance(material.diffuse.reflectance, tuple):
        diffuse = np.array(material.diffuse.reflectance) / (math.pi if scene.convention == "radiometric" else 1.0)
    return Surface(
        ambient=_vector(emitted + reflected),
        diffuse=_vector(diffuse),
        specular=material.specular.reflectance if material.specular else BLACK,
        exponent=material.specular.exponent if material.specular else 1.0,
    )


def _vector(values: NDArray[np.float64]) -> Vector:
    x, y, z = values.tolist()
    return x, y, z


def lamps_of(scene: Scene) -> tuple[Lamp, ...]:
    """The scene's lights as the worker is told of them, in the scene's order."""
    return tuple(_lamp(light) for light in scene.lights)


def _lamp(light: Light) -> Lamp:
    if not isinstance(light, PointLight):
        return Lamp(position=None, direction=light.direction, color=light.irradiance, attenuation=(1.0, 0.0, 0.0))
    attenuation = (0.0, 0.0, 1.0) if light.falloff == "inverse_square" else (1.0, 0.0, 0.0)
    if isinstance(light.falloff, PolynomialFalloff):
        attenuation = (light.falloff.constant, light.falloff.linear, light.falloff.quadratic)
    return Lamp(position=light.position, direction=BLACK, color=light.intensity, attenuation=attenuation)
