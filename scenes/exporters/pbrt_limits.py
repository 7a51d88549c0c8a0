"""What pbrt-v4 can express of a scene. Files named are those of its source, src/pbrt/."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.features import GEOMETRY, RADIOMETRIC_LIGHTS, Feature, missing_features
from raytruth.scenes.light_paths import comparable_depth
from raytruth.scenes.lights import PointLight
from raytruth.scenes.materials import CheckerboardColor, colors_of
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.requirements import required_features, used_materials

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene

# cpu/integrators.cpp, PathIntegrator::Li: light that shines by itself is added after at most maxdepth surfaces, and
# light from lights at the first maxdepth of them.
LIGHT_PATHS = "E[DS]{{0,{depth}}}(L|e)"

EXPRESSES = (
    GEOMETRY
    | RADIOMETRIC_LIGHTS
    | {Feature.BACKGROUND, Feature.CHECKERBOARD, Feature.EMISSION, Feature.DIFFUSE, Feature.DIELECTRICS}
)
REFUSED_FEATURES = {
    Feature.AMBIENT: "pbrt has no ambient light",
    Feature.PHONG: "pbrt has no Phong highlight",
    Feature.BLINN: "pbrt has no Blinn highlight",
    # materials.h, ConductorMaterial: a `reflectance` is turned into an index at normal incidence.
    Feature.MIRRORS: "a conductor of pbrt reflects more towards grazing angles, and a mirror of the scene does not",
    Feature.CONSTANT_SPLIT: "a dielectric of pbrt obeys Fresnel's equations and has no constant weights",
    Feature.ABSORPTION: "pbrt's path integrator has no absorbing media",
    Feature.BACKGROUND_GRADIENT: "pbrt has backgrounds of one colour or as images only, and an image rounds a gradient",
}


def refuses(scene: Scene) -> str | None:
    """Why pbrt cannot express this scene, in one clause that follows 'because'; None if it can."""
    without_planes = refuses_planes("pbrt", scene)
    if without_planes:
        return without_planes
    if any(isinstance(light, PointLight) and light.falloff != "inverse_square" for light in scene.lights):
        return "a point light of pbrt falls off with the inverse square of the distance and in no other way"
    required = required_features(scene)
    reasons = (
        *(reason for feature, reason in REFUSED_FEATURES.items() if feature in required),
        *(_refuses_material(scene, material) for material in used_materials(scene)),
    )
    return next((reason for reason in reasons if reason), None) or missing_features("pbrt", EXPRESSES, required)


def _refuses_material(scene: Scene, material: Material) -> str | None:
    whitted = scene.convention == "whitted"
    reasons = {
        "pbrt divides a diffuse reflectance by π, and the whitted convention does not": whitted and material.diffuse,
        # bxdfs.cpp, DielectricBxDF: `ft /= Sqr(etap)`.
        "pbrt scales radiance on refraction, and the whitted convention does not": whitted and material.dielectric,
        "a dielectric of pbrt has no diffuse or emissive term beside it": material.dielectric
        and (material.diffuse or material.emission),
        # lights.cpp, DiffuseAreaLight::Create.
        "an area light of pbrt has a texture as an image only, and here a checkerboard shines": material.emission
        and isinstance(material.emission.radiance, CheckerboardColor),
        # paramdict.cpp, extractSpectrumArray.
        "a reflectance of pbrt is at most 1": material.diffuse
        and max(map(max, colors_of(material.diffuse.reflectance))) > 1,
    }
    return next((reason for reason, holds in reasons.items() if holds), None)


def depth_of(scene: Scene) -> int | str:
    """The `maxdepth` at which pbrt sums the scene's light paths, or why there is none."""
    return comparable_depth(scene, LIGHT_PATHS, has_depth=True)


def notes(scene: Scene) -> list[str]:
    """What pbrt computes otherwise, each in one clause."""
    return list(_notes(scene))


def _notes(scene: Scene) -> Iterator[str]:
    yield "pbrt computes with spectra that it makes from colours, so that products of two colours differ slightly"
    depth = depth_of(scene)
    if isinstance(depth, str):
        yield depth
