from __future__ import annotations

from fractions import Fraction
from math import pi
from typing import Any

import pytest

from raytruth.reference_tracer.rendering import render
from tests.reference_tracer.kernels import EXACT
from tests.reference_tracer.small_scenes import lamp, small_scene, square

# The camera sees the sphere's point (0, 0, 1) head on, so that all numbers of the classical convention are rational.
ABOVE = (0.0, 0.0, 3.0)  # 2 before the point
ASIDE = (3.0, 0.0, 5.0)  # (3, 0, 4) from the point: distance 5, cosine 4/5
GLOSSY = {"specular": {"reflectance": (1.0, 0.5, 0.0), "exponent": 3.0, "model": "phong"}}
WHITE = {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}


def pixel(material: dict[str, Any], lights: list[dict[str, Any]], **changes: Any) -> Any:
    scene = small_scene(materials={"white": material}, lights=lights, **changes)
    return tuple(render(scene, EXACT)[0, 0])


@pytest.mark.clause("ILL-2")
def test_diffuse_light_follows_the_cosine() -> None:
    assert pixel(WHITE, [lamp(ABOVE)]) == (1, 1, 1)
    assert pixel(WHITE, [lamp(ASIDE)]) == (Fraction(4, 5),) * 3


@pytest.mark.clause("ILL-2")
def test_diffuse_colours_filter_the_light() -> None:
    material = {"diffuse": {"reflectance": (0.5, 0.25, 0.0)}}
    assert pixel(material, [lamp(ABOVE, 2.0)]) == (1, Fraction(1, 2), 0)


@pytest.mark.clause("ILL-2", "ILL-8", "IMG-3")
def test_lights_add_up() -> None:
    assert pixel(WHITE, [lamp(ABOVE), lamp(ASIDE), lamp(ASIDE)]) == (Fraction(13, 5),) * 3


@pytest.mark.clause("ILL-2")
@pytest.mark.parametrize("position", [(0.0, 0.0, -3.0), (3.0, 0.0, 1.0), (0.0, 0.0, 0.5)])
def test_a_light_behind_or_level_with_the_surface_gives_nothing(position: tuple[float, float, float]) -> None:
    assert pixel(WHITE | GLOSSY, [lamp(position)]) == (0, 0, 0)


@pytest.mark.clause("ILL-2")
def test_a_light_level_with_the_surface_makes_no_highlight_either() -> None:
    # Seen along (-4, 0, -3)/5, the mirrored direction and that to the lamp have the cosine 4/5.
    camera = {"position": (4.0, 0.0, 3.0)}
    level, raised = (
        pixel(GLOSSY, [lamp(position)], camera=camera, objects=[square("white", 0.0)])[0]
        for position in ((-5.0, 0.0, 0.0), (-4.0, 0.0, 3.0))
    )
    assert (level, raised) == (0, 1)


@pytest.mark.clause("ILL-7")
@pytest.mark.parametrize(
    ("falloff", "part"),
    [
        ("none", Fraction(1)),
        ("inverse_square", Fraction(1, 25)),
        ({"constant": 1.0, "linear": 0.5, "quadratic": 0.25}, 1 / (1 + Fraction(5, 2) + Fraction(25, 4))),
        ({"constant": 0.5, "linear": 0.0625, "quadratic": 0.0}, Fraction(1)),  # 1/(0.8125), limited to 1
        ({"constant": 0.5, "linear": 0.125, "quadratic": 0.0}, 1 / Fraction(9, 8)),  # barely not limited
        ({"constant": 0.0, "linear": 0.0, "quadratic": 1.0}, Fraction(1, 25)),
    ],
)
def test_light_falls_off_with_the_distance(falloff: Any, part: Fraction) -> None:
    assert pixel(WHITE, [lamp(ASIDE, 1.0, falloff)]) == (Fraction(4, 5) * part,) * 3


@pytest.mark.clause("ILL-7")
def test_each_light_has_its_own_falloff() -> None:
    lights = [lamp(ABOVE, 1.0, falloff) for falloff in ("none", "inverse_square")]
    assert pixel(WHITE, lights) == (Fraction(5, 4),) * 3


@pytest.mark.clause("ILL-5")
def test_phongs_highlight_is_a_power_of_the_cosine_between_mirrored_view_and_light() -> None:
    # Seen head on, the mirrored direction is the normal: (4/5)³.
    highlight = Fraction(4, 5) ** 3
    assert pixel(GLOSSY, [lamp(ASIDE)]) == (highlight, highlight / 2, 0)


@pytest.mark.clause("ILL-6")
def test_blinns_highlight_is_a_power_of_the_cosine_between_normal_and_halfway() -> None:
    # To the light (24, 0, 7)/25, to the viewer (0, 0, 1): halfway is (24, 0, 32), of length 40: (4/5)³.
    material = {"specular": GLOSSY["specular"] | {"model": "blinn"}}
    highlight = Fraction(4, 5) ** 3
    assert pixel(material, [lamp((24.0, 0.0, 8.0))]) == (highlight, highlight / 2, 0)
    # Phong's would be (7/25)³.
    assert pixel(GLOSSY, [lamp((24.0, 0.0, 8.0))])[0] == Fraction(7, 25) ** 3


@pytest.mark.clause("ILL-5", "ILL-6")
def test_models_may_differ_from_material_to_material() -> None:
    blinn = {"specular": GLOSSY["specular"] | {"model": "blinn"}}
    for shown, expected in ((GLOSSY, Fraction(7, 25) ** 3), (blinn, Fraction(4, 5) ** 3)):
        other = blinn if shown is GLOSSY else GLOSSY
        scene = small_scene(
            materials={"other": other, "white": shown},
            objects=[
                {"shape": "sphere", "center": (0.0, 0.0, 0.0), "radius": 1.0, "material": "white"},
                {"shape": "sphere", "center": (0.0, 0.0, -9.0), "radius": 1.0, "material": "other"},
            ],
            lights=[lamp((24.0, 0.0, 8.0))],
        )
        assert render(scene, EXACT)[0, 0, 0] == expected


@pytest.mark.clause("ILL-2", "ILL-4")
def test_ambient_and_emitted_light_need_no_lamp() -> None:
    ambient = {"ambient": {"reflectance": (0.5, 0.25, 1.0)}}
    assert pixel(ambient, [], ambient_light=(0.5, 1.0, 0.0)) == (Fraction(1, 4), Fraction(1, 4), 0)
    assert pixel({"emission": {"radiance": (0.5, 3.0, 0.0)}}, []) == (Fraction(1, 2), 3, 0)


@pytest.mark.clause("ILL-2", "ILL-8")
def test_all_terms_add_up() -> None:
    material = {
        **WHITE,
        **GLOSSY,
        "emission": {"radiance": (0.5, 0.5, 0.5)},
        "ambient": {"reflectance": (1.0, 1.0, 1.0)},
    }
    color = pixel(material, [lamp(ABOVE)], ambient_light=(0.25, 0.25, 0.25))
    assert color == (Fraction(11, 4), Fraction(9, 4), Fraction(7, 4))


@pytest.mark.clause("ILL-2", "ILL-7")
def test_directional_light_has_no_distance_and_comes_against_its_direction() -> None:
    sun = {"kind": "directional", "direction": (-3.0, 0.0, -4.0), "irradiance": (1.0, 2.0, 3.0)}
    assert pixel(WHITE, [sun]) == (Fraction(4, 5), Fraction(8, 5), Fraction(12, 5))
    assert pixel(WHITE, [sun | {"direction": (3.0, 0.0, 4.0)}]) == (0, 0, 0)


@pytest.mark.clause("ILL-3")
def test_the_radiometric_convention_divides_a_diffuse_reflectance_by_pi() -> None:
    assert pixel(WHITE, [lamp(ABOVE)], convention="radiometric") == (1 / Fraction(pi),) * 3


@pytest.mark.clause("ILL-1")
def test_surfaces_seen_from_within_are_lit_from_within() -> None:
    inside = {"camera": {"position": (0.0, 0.0, 0.5)}}
    assert pixel(WHITE, [lamp((0.0, 0.0, 0.0))], **inside) == (1, 1, 1)
    assert pixel(WHITE, [lamp((0.0, 0.0, -3.0))], **inside) == (0, 0, 0)
