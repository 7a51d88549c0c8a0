"""What glTF 2.0 can express of a scene, with its ratified extensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.exporters.triangle_soup import triangle_lists
from raytruth.scenes.features import BACKGROUNDS, RADIOMETRIC_LIGHTS, TRIANGLE_GEOMETRY, Feature, missing_features
from raytruth.scenes.lights import PointLight, shines
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.requirements import required_features, used_materials
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene

# Backgrounds are left out, which `notes` tells.
EXPRESSES = TRIANGLE_GEOMETRY | BACKGROUNDS | RADIOMETRIC_LIGHTS | {Feature.EMISSION, Feature.DIFFUSE, Feature.MIRRORS}


def refuses(scene: Scene) -> str | None:
    """Why glTF cannot express this scene, in one clause that follows 'because'; None if it can."""
    if any(isinstance(shape, Sphere) for shape in scene.objects):
        return "glTF has no spheres, and triangles in their place would be other surfaces"
    without_planes = refuses_planes("glTF", scene)
    if without_planes:
        return without_planes
    if any(isinstance(light, PointLight) and light.falloff != "inverse_square" for light in scene.lights):
        return "a point light of glTF falls off with the inverse square of the distance and in no other way"
    reasons = (_refuses_material(scene, material) for material in used_materials(scene))
    reason = next((reason for reason in reasons if reason), None)
    required = required_features(scene)
    if reason is None and Feature.ABSORPTION in required:  # of a medium that no object needs to be made of, too
        return "a camera of glTF is in empty space, and here it is in a medium that absorbs light"
    return reason or missing_features("glTF", EXPRESSES, required)


def _refuses_material(scene: Scene, material: Material) -> str | None:
    if Feature.CHECKERBOARD in material.features():
        return "glTF has textures as images of 8 bits only, whose colours and edges would not be the checkerboard's"
    mirror = material.mirror.reflectance if material.mirror else ()
    color = material.diffuse.reflectance if material.diffuse else ()
    diffuse = color if isinstance(color, tuple) else ()
    reasons = {
        "glTF has no ambient light": material.ambient and any(scene.ambient_light),
        "glTF has neither Phong's nor Blinn's specular term": material.specular,
        "glTF leaves to each viewer how it approximates Fresnel's equations for glass": material.dielectric,
        "glTF divides a diffuse reflectance by π, and the whitted convention does not": material.diffuse
        and scene.convention == "whitted",
        "a material of glTF weakens its diffuse term where it has a mirror": material.diffuse and material.mirror,
        "a coloured mirror of glTF is white towards grazing angles": len(set(mirror)) > 1,
        "a reflectance of glTF is at most 1": max((*mirror, *diffuse), default=0.0) > 1,
    }
    return next((reason for reason, holds in reasons.items() if holds), None)


def notes(scene: Scene) -> list[str]:
    """What is left out, rounded, or measured otherwise, each in one clause."""
    found = ["the image's size is left out but for its aspect ratio, and so is max_depth, since glTF has neither"]
    if shines(scene.background):
        found.append("the background is left out, since glTF has none")
    if scene.lights or any(material.emission for material in used_materials(scene)):
        found.append("a watt is written as a lumen, which scales all light alike")
    return [*found, *_rounding(scene)]


def _rounding(scene: Scene) -> Iterator[str]:
    stated = np.concatenate([np.ravel(triangle_lists(shape)[0]) for shape in scene.objects if shape.shape != "sphere"])
    errors: NDArray[np.float64] = np.abs(stated.astype(np.float32).astype(np.float64) - stated)
    if errors.any():
        count = np.count_nonzero(errors)
        yield f"{count} of {len(stated)} coordinates are rounded to float32, by at most {errors.max():.1e}"
