from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare, render
from raytruth.reference_tracer.source.ray_tree import surface_at
from tests.reference_tracer.kernels import EXACT
from tests.reference_tracer.small_scenes import small_scene, sphere, square

GLOW = {"emission": {"radiance": (1.0, 2.0, 4.0)}}
SKY = {"background": {"color": (1.0, 2.0, 4.0)}}
MIRROR = {"mirror": {"reflectance": (0.5, 0.25, 1.0)}}
GLASS: dict[str, Any] = {"dielectric": {"index_of_refraction": 1.5}}
REFLECTANCE = Fraction(1, 25)  # ((n - 1)/(n + 1))² head on


def pixel(materials: dict[str, Any], objects: list[Any], **changes: Any) -> Any:
    arithmetic = replace(EXACT, functions={**EXACT.functions, "exp": lambda x: 1 + x})  # rational, as nothing else is
    return tuple(render(small_scene(materials=materials, objects=objects, **changes), arithmetic)[0, 0])


@pytest.mark.clause("REFL-2", "TREE-2")
def test_a_mirror_shows_what_stands_before_it_times_its_reflectance() -> None:
    # The camera stands between: a window of depth 0 shows only the mirror, which is black by itself.
    materials, objects = {"mirror": MIRROR, "glow": GLOW}, [square("mirror", 0.0), square("glow", 8.0)]
    assert pixel(materials, objects, max_depth=1) == (Fraction(1, 2), Fraction(1, 2), 4)
    assert pixel(materials, objects, max_depth=0) == (0, 0, 0)


@pytest.mark.clause("TREE-1", "TREE-2")
@pytest.mark.parametrize("depth", [1, 2, 3, 8])
def test_facing_mirrors_give_a_geometric_series(depth: int) -> None:
    part = Fraction(1, 2)
    mirror = {"mirror": {"reflectance": (0.5, 0.5, 0.5)}, "emission": {"radiance": (1.0, 1.0, 1.0)}}
    color = pixel({"mirror": mirror}, [square("mirror", 0.0), square("mirror", 8.0)], max_depth=depth)
    assert color == (sum(part**k for k in range(depth + 1)),) * 3


@pytest.mark.clause("BG-2")
def test_a_mirror_in_the_void_shows_the_background() -> None:
    assert pixel({"mirror": MIRROR}, [square("mirror", 0.0)], max_depth=1, **SKY) == (Fraction(1, 2), Fraction(1, 2), 4)


@pytest.mark.clause("REFR-5")
def test_one_surface_of_glass_splits_light_by_fresnel() -> None:
    # The sky behind a single surface; the way in changes radiance by 1/η² in the radiometric convention only.
    materials = {"glass": GLASS, "glow": GLOW}
    objects = [square("glass", 0.0), square("glow", -4.0)]
    classical = pixel(materials, objects, max_depth=1)
    assert classical == tuple((1 - REFLECTANCE) * part for part in (1, 2, 4))
    radiometric = pixel(materials, objects, max_depth=1, convention="radiometric")
    assert radiometric == tuple((1 - REFLECTANCE) * part / Fraction(9, 4) for part in (1, 2, 4))


@pytest.mark.clause("REFR-5")
@pytest.mark.parametrize("convention", ["whitted", "radiometric"])
def test_through_a_ball_of_glass_both_scalings_cancel(convention: str) -> None:
    # Head on through both sides; the ray reflected inside ends at depth 2. Outside is the sky on all sides.
    color = pixel({"glass": GLASS}, [sphere("glass")], max_depth=2, convention=convention, **SKY)
    through = (1 - REFLECTANCE) ** 2
    assert color == tuple((REFLECTANCE + through) * part for part in (1, 2, 4))


@pytest.mark.clause("TREE-1", "TREE-3")
def test_deeper_trees_add_the_reflections_inside() -> None:
    # Depth 3: once reflected inside, then out at the front, too.
    color = pixel({"glass": GLASS}, [sphere("glass")], max_depth=3, **SKY)
    seen = REFLECTANCE + (1 - REFLECTANCE) ** 2 * (1 + REFLECTANCE)
    assert color == tuple(seen * part for part in (1, 2, 4))


@pytest.mark.clause("REFR-6")
def test_a_constant_split_weighs_both_rays_by_its_constants() -> None:
    glass = {"dielectric": GLASS["dielectric"] | {"reflectance": (0.5, 0.0, 0.25), "transmittance": (0.25, 1.0, 0.5)}}
    color = pixel({"glass": glass}, [square("glass", 0.0)], max_depth=1, **SKY)
    assert color == (Fraction(3, 4), 2, 3)


@pytest.mark.clause("REFR-7", "REFR-9", "BG-3")
def test_a_medium_absorbs_along_the_way_inside_it() -> None:
    glass = {"dielectric": GLASS["dielectric"] | {"absorption": (0.0, 0.125, 0.25)}}
    color = pixel({"glass": glass}, [sphere("glass")], max_depth=2, **SKY)
    # The stand-in for exp is 1 - σ·2.
    through = [(1 - REFLECTANCE) ** 2 * part for part in (Fraction(1), Fraction(3, 4), Fraction(1, 2))]
    assert color == tuple((REFLECTANCE + inside) * part for inside, part in zip(through, (1, 2, 4), strict=True))


@pytest.mark.clause("REFR-1")
def test_a_bubble_in_water_sees_water_outside() -> None:
    # Index 2 outside, index 1 inside the ball: the ratio is 1/2, the reflectance head on 1/9.
    materials = {
        "water": {"dielectric": {"index_of_refraction": 2.0}},
        "air": {"dielectric": {"index_of_refraction": 1.0, "outside": "water"}},
    }
    camera = {"camera": {"inside": "water"}}
    color = pixel(materials, [sphere("air")], max_depth=1, **camera, **SKY)
    assert color[0] == Fraction(1, 9)  # what is reflected meets the sky; what enters ends inside at depth 1


@pytest.mark.clause("CAM-5", "REFR-7")
def test_the_camera_in_a_medium_sees_the_absorbed_light() -> None:
    materials = {"water": {"dielectric": {"index_of_refraction": 2.0, "absorption": (0.125, 0.0, 0.0)}}, "glow": GLOW}
    objects = [square("glow", 3.0), sphere("water", (0.0, 0.0, -50.0))]
    color = pixel(materials, objects, max_depth=1, camera={"inside": "water"})
    assert color == (Fraction(3, 4), 2, 4)


@pytest.mark.clause("REFR-2", "REFR-5")
def test_total_reflection_sends_everything_back() -> None:
    # From within glass at 45°, whose sine is above 1/1.5: the square of the cosine is 1/2.
    scene = small_scene(
        projection="orthographic",
        camera={"position": (3.0, 0.0, 3.0), "look_at": (0.0, 0.0, 0.0), "inside": "glass"},
        materials={"glass": GLASS, "glow": GLOW},
        objects=[turned_square("glass", -1.0), {**square("glow", 50.0), "material": "glow"}],
        max_depth=1,
    )
    # The glass's surface at z = -1 faces down, so the camera above it is inside; what is mirrored goes up to the glow.
    color = render(scene, FLOAT)[0, 0]
    assert tuple(color) == (1.0, 2.0, 4.0)


@pytest.mark.clause("REFR-2", "REFR-6")
def test_at_exactly_the_critical_angle_light_is_split() -> None:
    # From within index 5/4, with the cosine 3/5: g² = (4/5)² - 1 + (3/5)² is 0. With constant weights that shows.
    glass = {"index_of_refraction": 1.25, "reflectance": (0.5, 0.25, 0.125), "transmittance": (0.25, 0.5, 0.5)}
    camera = {"position": (4.0, 0.0, 3.0), "look_at": (0.0, 0.0, 0.0), "inside": "glass"}
    color = pixel(
        {"glass": {"dielectric": glass}},
        [turned_square("glass", -1.0)],
        camera=camera,
        projection="orthographic",
        max_depth=1,
        **SKY,
    )
    assert color == (Fraction(3, 4), Fraction(3, 2), Fraction(5, 2))


def turned_square(material: str, z: float) -> dict[str, Any]:
    turned = square(material, z)
    return {**turned, "faces": tuple((a, c, b) for a, b, c in turned["faces"])}


@pytest.mark.clause("ILL-1")
def test_normals_are_turned_to_the_ray_and_tell_whether_it_enters() -> None:
    prepared = prepare(small_scene(), FLOAT)
    for z, direction, entering in ((5.0, -1.0, True), (0.0, -1.0, False), (0.0, 1.0, False), (-5.0, 1.0, True)):
        ray = (0.0, 0.0, direction)
        distance = 4.0 if entering else 1.0
        point, normal, enters = surface_at(prepared.data, (0.0, 0.0, z), ray, distance, 0)
        assert point == (0.0, 0.0, z + distance * direction)
        assert normal[2] == -direction
        assert enters == entering


@pytest.mark.clause("ILL-1")
def test_a_ray_that_exactly_grazes_a_sphere_leaves_it() -> None:
    prepared = prepare(small_scene(), FLOAT)
    point, normal, enters = surface_at(prepared.data, (-3.0, 1.0, 0.0), (1.0, 0.0, 0.0), 3.0, 0)
    assert (point, normal, enters) == ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0), False)
