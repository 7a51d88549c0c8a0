"""A bound on what any ray of a scene can bring back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.scenes.lights import ConstantBackground
from raytruth.scenes.materials import Dielectric, Emission, Mirror, colors_of
from raytruth.scenes.media import index_of_medium
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class RadianceBound:
    """The largest radiance that rays of a scene can bring back."""

    radiance: float
    """The brightest that a ray can bring, in any medium."""
    at_camera: float
    """The brightest that a camera ray, or one random sample of it, can bring."""
    growth: float
    """How much larger than its parent's the weight of a ray can be."""


def radiance_bound(scene: Scene) -> RadianceBound | None:
    """From the brightest emission or background; None where no bound is known.

    Surfaces that are lit have no simple bound, since a point light may be arbitrarily near; nor have surfaces that
    give back more than they get, or have a term that is not known here. Along a path the factors 1/η² of the
    radiometric convention multiply to the square of the index of the camera's medium over that of the last one.
    """
    emissions = [_brightest_emission(material) for material in used_materials(scene)]
    known = [emission for emission in emissions if emission is not None]
    if len(known) < len(emissions):
        return None
    brightest = max(_brightest_background(scene), *known)
    indices = [1.0, *(m.dielectric.index_of_refraction for m in scene.materials.values() if m.dielectric)]
    if scene.convention != "radiometric":
        return RadianceBound(brightest, brightest, 1.0)
    from_camera = (index_of_medium(scene, scene.camera.inside) / min(indices)) ** 2
    between_media = (max(indices) / min(indices)) ** 2
    return RadianceBound(brightest * between_media, brightest * from_camera, between_media)


def _brightest_emission(material: Material) -> float | None:
    """Of a surface that gives back no more than it gets from further rays; None for any other.

    Each of these terms alone conserves energy; two of them add up.
    """
    term, *others = material.terms().values()
    if others:
        return None
    if isinstance(term, Emission):
        return max(map(max, colors_of(term.radiance)))
    conserves_energy = (isinstance(term, Mirror) and max(term.reflectance) <= 1) or (
        isinstance(term, Dielectric) and term.reflectance is None
    )
    return 0.0 if conserves_energy else None


def _brightest_background(scene: Scene) -> float:
    if isinstance(scene.background, ConstantBackground):
        return max(scene.background.color)
    return max(*scene.background.bottom, *scene.background.top)
