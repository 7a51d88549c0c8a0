"""What a scene requires, derived from it: kernels, exporters and the matrix all use this one answer."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

from raytruth.scenes.lights import GradientBackground, PolynomialFalloff

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene

# A tree of boxes pays from about this many triangles on: below, the linear scan is as fast, and simpler to certify.
TRIANGLES_WITHOUT_TREE = 16


class Feature(StrEnum):
    """What a renderer must have to render a scene."""

    PERSPECTIVE = "PERSPECTIVE"
    SPHERES = "SPHERES"
    TRIANGLES = "TRIANGLES"
    BOUNDING_VOLUMES = "BOUNDING_VOLUMES"
    BACKGROUND = "BACKGROUND"
    BACKGROUND_GRADIENT = "BACKGROUND_GRADIENT"
    CHECKERBOARD = "CHECKERBOARD"
    EMISSION = "EMISSION"
    AMBIENT = "AMBIENT"
    DIFFUSE = "DIFFUSE"
    PHONG = "PHONG"
    BLINN = "BLINN"
    POINT_LIGHTS = "POINT_LIGHTS"
    DIRECTIONAL_LIGHTS = "DIRECTIONAL_LIGHTS"
    INVERSE_SQUARE_FALLOFF = "INVERSE_SQUARE_FALLOFF"
    POLYNOMIAL_FALLOFF = "POLYNOMIAL_FALLOFF"
    MIRRORS = "MIRRORS"
    DIELECTRICS = "DIELECTRICS"
    CONSTANT_SPLIT = "CONSTANT_SPLIT"
    ABSORPTION = "ABSORPTION"
    RADIOMETRIC = "RADIOMETRIC"


def required_features(scene: Scene) -> frozenset[Feature]:
    """The features without which the scene cannot be rendered; a material that no object has requires nothing."""
    return frozenset(
        (
            *_camera_and_convention(scene),
            *_shapes(scene),
            *_lights(scene),
            *(feature for material in used_materials(scene) for feature in _material(scene, material)),
            *_media(scene),
        )
    )


def used_materials(scene: Scene) -> list[Material]:
    """The materials that some object has, in the order of the scene."""
    used = {shape.material for shape in scene.objects}
    return [material for name, material in scene.materials.items() if name in used]


def _camera_and_convention(scene: Scene) -> Iterator[Feature]:
    if scene.camera.projection == "perspective":
        yield Feature.PERSPECTIVE
    if scene.convention == "radiometric":
        yield Feature.RADIOMETRIC
    if isinstance(scene.background, GradientBackground):
        yield Feature.BACKGROUND_GRADIENT
    elif any(scene.background.color):
        yield Feature.BACKGROUND


def _shapes(scene: Scene) -> Iterator[Feature]:
    triangles = 0
    for shape in scene.objects:
        if shape.shape == "sphere":
            yield Feature.SPHERES
        else:
            triangles += 1 if shape.shape == "triangle" else len(shape.faces)
    if triangles:
        yield Feature.TRIANGLES
    if triangles > TRIANGLES_WITHOUT_TREE:
        yield Feature.BOUNDING_VOLUMES


def _lights(scene: Scene) -> Iterator[Feature]:
    if not any(material.diffuse or material.specular for material in used_materials(scene)):
        return  # nothing that a point light could light
    for light in scene.lights:
        if light.kind == "directional":
            yield Feature.DIRECTIONAL_LIGHTS
            continue
        yield Feature.POINT_LIGHTS
        if isinstance(light.falloff, PolynomialFalloff):
            yield Feature.POLYNOMIAL_FALLOFF
        elif light.falloff == "inverse_square":
            yield Feature.INVERSE_SQUARE_FALLOFF


def _material(scene: Scene, material: Material) -> Iterator[Feature]:
    lit = bool(scene.lights)
    if material.ambient and any(scene.ambient_light):
        yield Feature.AMBIENT
    if material.emission:
        yield Feature.EMISSION
        if not isinstance(material.emission.radiance, tuple):
            yield Feature.CHECKERBOARD
    if material.diffuse and lit:
        yield Feature.DIFFUSE
        if not isinstance(material.diffuse.reflectance, tuple):
            yield Feature.CHECKERBOARD
    if material.specular and lit:
        yield Feature.PHONG if material.specular.model == "phong" else Feature.BLINN
    if material.mirror and scene.max_depth > 0:
        yield Feature.MIRRORS
    if material.dielectric and scene.max_depth > 0:
        yield Feature.DIELECTRICS
        if material.dielectric.reflectance:
            yield Feature.CONSTANT_SPLIT


def _media(scene: Scene) -> Iterator[Feature]:
    """A medium absorbs if a ray can be in it: the camera's, that of a dielectric object, or the one outside of it."""
    names = {scene.camera.inside}
    if scene.max_depth > 0:
        for shape in scene.objects:
            dielectric = scene.materials[shape.material].dielectric
            if dielectric:
                names |= {shape.material, dielectric.outside}
    media = (scene.materials[name].dielectric for name in names if name is not None)
    if any(medium and medium.absorption and any(medium.absorption) for medium in media):
        yield Feature.ABSORPTION
