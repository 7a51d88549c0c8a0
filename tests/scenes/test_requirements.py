from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from raytruth.scenes.features import Feature
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.requirements import TRIANGLES_WITHOUT_TREE, required_features, used_materials
from tests.scenes.exporter_scenes import BALL, BOARD, FLOOR, GLASS, LAMP, MIRROR, PLANE, POINT, RED, SUN, build

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("SCN-6")

AMBIENT = {"ambient": {"reflectance": (0.1, 0.1, 0.1)}}
PHONG = {"specular": {"reflectance": (0.5, 0.5, 0.5), "exponent": 9.0, "model": "phong"}}
BLINN = {"specular": PHONG["specular"] | {"model": "blinn"}}
POLYNOMIAL = POINT | {"falloff": {"constant": 1.0, "linear": 0.0, "quadratic": 0.5}}
CLASSICAL_GLASS = {"index_of_refraction": 1.5, "reflectance": (0.1,) * 3, "transmittance": (0.9,) * 3}
WHITE = {"color": (1.0, 1.0, 1.0)}


def scene(**changes: Any) -> Scene:
    """By default nothing but a sphere in perspective, in the classical convention."""
    return build(**{"convention": "whitted", "lights": [POINT | {"falloff": "none"}]} | changes)


def material(*terms: dict[str, Any], **changes: Any) -> Scene:
    stated: dict[str, Any] = {}
    for term in terms:
        stated |= term
    return scene(materials={"m": stated}, **changes)


# What changes, and which features that adds to those of a diffuse sphere under a point light or takes from them.
LIT_SPHERE = {Feature.PERSPECTIVE, Feature.SPHERES, Feature.DIFFUSE, Feature.POINT_LIGHTS}
UNLIT_SPHERE = {Feature.PERSPECTIVE, Feature.SPHERES}
CASES = [
    (scene(), LIT_SPHERE),
    (scene(convention="radiometric"), LIT_SPHERE | {Feature.RADIOMETRIC}),
    (scene(lights=[POINT]), LIT_SPHERE | {Feature.INVERSE_SQUARE_FALLOFF}),
    (scene(lights=[POLYNOMIAL]), LIT_SPHERE | {Feature.POLYNOMIAL_FALLOFF}),
    (scene(lights=[SUN]), LIT_SPHERE - {Feature.POINT_LIGHTS} | {Feature.DIRECTIONAL_LIGHTS}),
    (
        scene(lights=[SUN, POINT, POLYNOMIAL]),
        LIT_SPHERE | {Feature.DIRECTIONAL_LIGHTS, Feature.INVERSE_SQUARE_FALLOFF, Feature.POLYNOMIAL_FALLOFF},
    ),
    (scene(lights=[]), UNLIT_SPHERE),
    (scene(background=WHITE), LIT_SPHERE | {Feature.BACKGROUND}),
    (scene(background={"bottom": (0.0,) * 3, "top": (1.0,) * 3}), LIT_SPHERE | {Feature.BACKGROUND_GRADIENT}),
    (scene(objects=[FLOOR]), LIT_SPHERE - {Feature.SPHERES} | {Feature.TRIANGLES}),
    (scene(objects=[FLOOR, BALL]), LIT_SPHERE | {Feature.TRIANGLES}),
    (scene(objects=[PLANE]), LIT_SPHERE - {Feature.SPHERES} | {Feature.PLANES}),
    (scene(objects=[PLANE, FLOOR, BALL]), LIT_SPHERE | {Feature.PLANES, Feature.TRIANGLES}),
    (material(RED, AMBIENT, ambient_light=(0.0, 0.1, 0.0)), LIT_SPHERE | {Feature.AMBIENT}),
    (material(RED, AMBIENT), LIT_SPHERE),
    (material(RED, ambient_light=(0.1, 0.1, 0.1)), LIT_SPHERE),
    (material(RED, PHONG), LIT_SPHERE | {Feature.PHONG}),
    (material(BLINN), LIT_SPHERE - {Feature.DIFFUSE} | {Feature.BLINN}),
    (material(RED, PHONG, lights=[]), UNLIT_SPHERE),
    (material({"diffuse": {"reflectance": BOARD}}), LIT_SPHERE | {Feature.CHECKERBOARD}),
    (material({"diffuse": {"reflectance": BOARD}}, lights=[]), UNLIT_SPHERE),
    (material(LAMP), UNLIT_SPHERE | {Feature.EMISSION}),
    (material({"emission": {"radiance": BOARD}}), UNLIT_SPHERE | {Feature.EMISSION, Feature.CHECKERBOARD}),
    (material(MIRROR), UNLIT_SPHERE),
    (material(MIRROR, max_depth=1), UNLIT_SPHERE | {Feature.MIRRORS}),
    (material(GLASS), UNLIT_SPHERE),
    (material(GLASS, max_depth=1), UNLIT_SPHERE | {Feature.DIELECTRICS}),
    (
        material({"dielectric": {"index_of_refraction": 1.5, "absorption": (0.1,) * 3}}, max_depth=1),
        UNLIT_SPHERE | {Feature.DIELECTRICS, Feature.ABSORPTION},
    ),
    (
        material({"dielectric": CLASSICAL_GLASS}, max_depth=1),
        UNLIT_SPHERE | {Feature.DIELECTRICS, Feature.CONSTANT_SPLIT},
    ),
]


@pytest.mark.parametrize(("of", "expected"), CASES)
def test_a_scene_requires_exactly_the_features_that_it_uses(of: Scene, expected: set[Feature]) -> None:
    assert required_features(of) == expected


def test_an_orthographic_camera_needs_no_perspective() -> None:
    camera: dict[str, Any] = {"projection": "orthographic", "position": (0.0, 0.0, 5.0), "look_at": (0.0, 0.0, 0.0)}
    assert required_features(scene(camera=camera | {"width": 4, "height": 3, "view_height": 2.0})) == LIT_SPHERE - {
        Feature.PERSPECTIVE
    }


def test_a_material_that_no_object_has_requires_nothing() -> None:
    everything = RED | AMBIENT | PHONG | LAMP
    unused = {"a": everything | MIRROR, "b": everything | GLASS, "c": {"diffuse": {"reflectance": BOARD}}, "m": RED}
    of = scene(materials=unused, max_depth=3, ambient_light=(1.0, 1.0, 1.0))
    assert required_features(of) == LIT_SPHERE
    assert used_materials(of) == [of.materials["m"]]


def test_used_materials_keep_the_order_of_the_scene() -> None:
    of = scene(materials={"z": RED, "a": LAMP, "m": MIRROR}, objects=[BALL, BALL | {"material": "z"}, BALL])
    assert used_materials(of) == [of.materials["z"], of.materials["m"]]


@pytest.mark.parametrize("parts", [1, 3])
def test_more_triangles_than_a_scan_is_good_for_require_bounding_volumes(parts: int) -> None:
    def needs_tree(triangles: int) -> bool:
        """With the triangles in one mesh, or single ones beside it."""
        mesh = {"shape": "mesh", "vertices": FLOOR["vertices"], "material": "m"}
        faces = [(0, 1, 2)] * (triangles - (parts - 1))
        objects = [mesh | {"faces": faces}, *([FLOOR] * (parts - 1)), BALL]
        return Feature.BOUNDING_VOLUMES in required_features(scene(objects=objects))

    assert not needs_tree(TRIANGLES_WITHOUT_TREE)
    assert needs_tree(TRIANGLES_WITHOUT_TREE + 1)


def test_the_library_has_a_scene_for_every_feature() -> None:
    required = [required_features(open_scene(name)) for name in library_names()]
    assert frozenset().union(*required) == frozenset(Feature)
