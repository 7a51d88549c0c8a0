"""A bound on what any ray of a scene can bring back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.lights import ConstantBackground
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.materials import Material, Texture
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class RadianceBound:
    """What no ray of a scene can exceed."""

    radiance: float
    """The brightest that a ray can bring, in any medium."""
    at_camera: float
    """The brightest that a camera ray, or one random sample of it, can bring."""
    growth: float
    """How much larger than its parent's the weight of a ray can be."""


def radiance_bound(scene: Scene) -> RadianceBound | None:
    """From the brightest emission or background; None where no bound is known.

    Surfaces that are lit have no simple bound, since a point light may be arbitrarily near; nor have surfaces that
    give back more than they get. Along a path the factors 1/η² of the radiometric convention multiply to the square of
    the index of the camera's medium over that of the last one.
    """
    if not all(_conserves_energy_and_is_unlit(material) for material in used_materials(scene)):
        return None
    indices = [1.0, *(m.dielectric.index_of_refraction for m in scene.materials.values() if m.dielectric)]
    brightest = max(_radiances(scene))
    if scene.convention != "radiometric":
        return RadianceBound(brightest, brightest, 1.0)
    from_camera = (_camera_index(scene) / min(indices)) ** 2
    between_media = (max(indices) / min(indices)) ** 2
    return RadianceBound(brightest * between_media, brightest * from_camera, between_media)


def _camera_index(scene: Scene) -> float:
    """Of the medium that the camera is in."""
    inside = scene.materials[scene.camera.inside].dielectric if scene.camera.inside else None
    return inside.index_of_refraction if inside else 1.0


def _conserves_energy_and_is_unlit(material: Material) -> bool:
    lit = material.diffuse or material.specular or material.ambient
    amplifies = material.mirror is not None and max(material.mirror.reflectance) > 1
    constants = material.dielectric is not None and material.dielectric.reflectance is not None
    # Each of these alone conserves energy; two of them add up.
    several = [material.mirror, material.dielectric, material.emission].count(None) < 2
    return not (lit or amplifies or constants or several)


def _radiances(scene: Scene) -> Iterator[float]:
    if isinstance(scene.background, ConstantBackground):
        yield max(scene.background.color)
    else:
        yield max(*scene.background.bottom, *scene.background.top)
    for material in used_materials(scene):
        if material.emission:
            yield _brightest(material.emission.radiance)


def _brightest(texture: Texture) -> float:
    if isinstance(texture, tuple):
        return max(texture)
    return max(*texture.checkerboard.even, *texture.checkerboard.odd)
