"""What a scene requires, derived from it: kernels, exporters and the matrix all use this one answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.features import Feature
from raytruth.scenes.lights import GradientBackground, PolynomialFalloff

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.materials import Material, Term
    from raytruth.scenes.scene import Scene

# A tree of boxes pays from about this many triangles on: below, the linear scan is as fast, and simpler to certify.
TRIANGLES_WITHOUT_TREE = 16


def required_features(scene: Scene) -> frozenset[Feature]:
    """The features without which the scene cannot be rendered; a material that no object has requires nothing."""
    return frozenset(
        (
            *_camera_and_convention(scene),
            *_shapes(scene),
            *_lights(scene),
            *(feature for term in _terms_that_show(scene) for feature in term.features()),
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
        elif shape.shape == "plane":
            yield Feature.PLANES
        else:
            triangles += 1 if shape.shape == "triangle" else len(shape.faces)
    if triangles:
        yield Feature.TRIANGLES
    if triangles > TRIANGLES_WITHOUT_TREE:
        yield Feature.BOUNDING_VOLUMES


def _lights(scene: Scene) -> Iterator[Feature]:
    if not any("lights" in material.light_from() for material in used_materials(scene)):
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


def _terms_that_show(scene: Scene) -> Iterator[Term]:
    """The terms of used materials to which the scene sends any light."""
    shows = {
        "lights": bool(scene.lights),
        "ambient light": any(scene.ambient_light),
        "rays": scene.max_depth > 0,
        "itself": True,
    }
    for material in used_materials(scene):
        yield from (term for term in material.terms().values() if shows[term.light_from])


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
