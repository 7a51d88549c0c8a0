"""What POV-Ray cannot express is refused."""

from __future__ import annotations

from typing import Any

import pytest

from raytruth.scenes.exporters.povray_limits import FARTHEST, LARGEST_UNIT, refuses, unit_of
from raytruth.scenes.extent import extent_of
from tests.scenes.exporter_scenes import BALL, FLOOR, GLASS, MIRROR, PLANE, POINT, RED, SUN, build

pytestmark = pytest.mark.clause("REN-3")

POLYNOMIAL = POINT | {"falloff": {"constant": 1.0, "linear": 0.1, "quadratic": 0.1}}
WEIGHTS = {"index_of_refraction": 1.5, "reflectance": (0.1, 0.1, 0.1), "transmittance": (0.9, 0.9, 0.9)}
CORNERS = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
TETRAHEDRON = {"shape": "mesh", "vertices": CORNERS, "faces": FACES, "material": "m"}
CAMERA: dict[str, Any] = {
    "projection": "perspective",
    "position": (0.0, 1.0, 5.0),
    "look_at": (0.0, 0.0, 0.0),
    "width": 32,
    "height": 24,
    "vertical_field_of_view": 40.0,
}
PARALLEL = {key: value for key, value in CAMERA.items() if key != "vertical_field_of_view"} | {
    "projection": "orthographic",
    "view_height": 3.0,
}
UNDER_WATER = {"m": RED, "water": {"dielectric": {"index_of_refraction": 1.33, "absorption": (0.1, 0.1, 0.1)}}}


def glass(**changes: Any) -> dict[str, Any]:
    return {"materials": {"m": GLASS}, "max_depth": 2} | changes


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"max_depth": 13}, "float32"),
        ({"objects": [BALL | {"center": (9e6, 0.0, 0.0)}]}, "farther than 1e+07 units"),
        ({"lights": [POLYNOMIAL, SUN]}, "polynomial"),
        (glass(materials={"m": {"dielectric": WEIGHTS | {"index_of_refraction": 0.7}}}), "totally reflected"),
        (glass(materials={"m": {"dielectric": WEIGHTS | {"reflectance": (0.1, 0.0, 0.1)}}}), "weight of 0"),
        (glass(materials={"m": {"dielectric": {"index_of_refraction": 1.0}}}), "equal indices"),
        (glass(objects=[FLOOR]), "closed"),
        (glass(objects=[TETRAHEDRON | {"faces": FACES[1:]}]), "closed"),
        (glass(objects=[TETRAHEDRON | {"faces": [face[::-1] for face in FACES]}]), "inward"),
        (glass(objects=[BALL, BALL | {"center": (2.2, 0.2, 0.3)}]), "overlap"),
        (glass(objects=[BALL, TETRAHEDRON]), "overlap"),
        (glass(objects=[BALL | {"center": (0.0, 1.0, 5.2)}]), "camera may be inside"),
        (glass(camera=CAMERA | {"inside": "m"}), "camera's medium"),
        ({"materials": UNDER_WATER, "camera": CAMERA | {"inside": "water"}}, "camera's medium"),
        ({"materials": UNDER_WATER, "camera": PARALLEL | {"inside": "water"}}, "parallel rays"),
        (glass(objects=[BALL, PLANE]), "overlap"),
        (glass(objects=[PLANE | {"normal": (0.0, -1.0, 0.0)}]), "camera may be inside"),
        (glass(objects=[PLANE], camera=CAMERA | {"inside": "m"}), "camera's medium"),
        (glass(camera=PARALLEL, objects=[PLANE]), "parallel rays"),
        (glass(camera=PARALLEL, objects=[BALL | {"center": (9.0, 1.0, 5.0)}]), "parallel rays"),
    ],
)
def test_what_povray_cannot_express_is_refused_with_its_reason(changes: dict[str, Any], word: str) -> None:
    reason = refuses(build(**changes))
    assert reason is not None
    assert word in reason


SMALL_BALL = BALL | {"radius": 0.5}


def nested(inner: dict[str, Any], around: dict[str, Any] = GLASS, **bubble: Any) -> str | None:
    """Why a dielectric in or beside a ball of another is refused."""
    medium = {"dielectric": {"index_of_refraction": 1.2, "outside": "m"} | bubble}
    changes = glass(materials={"m": around, "bubble": medium}, objects=[BALL, inner | {"material": "bubble"}])
    return refuses(build(**changes))


def test_a_sphere_wholly_inside_the_medium_it_is_declared_in_is_not_refused() -> None:
    assert nested(SMALL_BALL) is None


@pytest.mark.parametrize(
    ("inner", "changes", "word"),
    [
        (SMALL_BALL | {"center": (0.9, 0.2, 0.3)}, {}, "overlap"),
        (SMALL_BALL, {"outside": None}, "outside is not the object around"),
        (BALL | {"center": (2.4, 0.2, 0.3)}, {}, "outside is not the object around"),
        (SMALL_BALL, {"index_of_refraction": 1.5}, "equal indices"),
        (TETRAHEDRON | {"vertices": tuple((x / 9, y / 9, z / 9) for x, y, z in CORNERS)}, {}, "overlap"),
        (SMALL_BALL, {"around": {"dielectric": {"index_of_refraction": 1.5, "absorption": (1, 0, 0)}}}, "absorb"),
        (SMALL_BALL, {"around": {"dielectric": WEIGHTS}}, "absorb"),
    ],
)
def test_any_other_dielectric_at_another_is_refused(inner: dict[str, Any], changes: dict[str, Any], word: str) -> None:
    assert word in str(nested(inner, **changes))


@pytest.mark.parametrize(
    "changes",
    [
        {"materials": {"m": RED | MIRROR}, "max_depth": 12, "lights": [POINT, SUN], "convention": "whitted"},
        {"lights": [POLYNOMIAL]},
        glass(materials={"m": {"dielectric": WEIGHTS}}),
        glass(objects=[TETRAHEDRON]),
        glass(objects=[BALL, BALL | {"center": (2.4, 0.2, 0.3)}]),
        glass(camera=CAMERA | {"inside": "m"}, objects=[BALL | {"center": (0.0, 1.0, 5.2)}]),
        glass(camera=PARALLEL),
        {"materials": {"m": GLASS}, "objects": [FLOOR]},
    ],
)
def test_what_povray_can_express_is_not_refused(changes: dict[str, Any]) -> None:
    assert refuses(build(**changes)) is None


@pytest.mark.parametrize("radius", [10.0 ** (exponent / 2) for exponent in range(15)])
def test_the_unit_is_the_largest_power_of_two_with_which_all_is_near_enough(radius: float) -> None:
    scene = build(objects=[BALL, BALL | {"center": (0.0, -radius, 0.0), "radius": radius}])
    if refuses(scene) is not None:
        assert extent_of(scene) > FARTHEST
        return
    unit = unit_of(scene)
    assert unit.bit_count() == 1
    assert extent_of(scene) * unit <= FARTHEST
    assert unit == LARGEST_UNIT or extent_of(scene) * 2 * unit > FARTHEST


def test_the_usual_ground_sphere_is_not_refused() -> None:
    ground = BALL | {"center": (0.0, -1000.0, 0.0), "radius": 1000.0}
    assert refuses(build(objects=[BALL, ground], lights=[POINT, SUN])) is None


@pytest.mark.parametrize(
    "changes",
    [
        {"objects": [PLANE, BALL], "lights": [POINT, SUN]},
        glass(objects=[PLANE]),
        glass(objects=[PLANE | {"normal": (0.0, -1.0, 0.0)}], camera=CAMERA | {"inside": "m"}),
    ],
)
def test_planes_are_expressed_also_of_glass_and_from_within(changes: dict[str, Any]) -> None:
    assert refuses(build(**changes)) is None
