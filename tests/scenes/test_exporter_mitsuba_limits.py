"""What Mitsuba cannot express is refused, and which sides shine is derived."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from raytruth.scenes.exporters.mitsuba import export_mitsuba
from raytruth.scenes.exporters.mitsuba_limits import refuses, reversed_primitives
from tests.scenes.exporter_scenes import BALL, BOARD, FLOOR, GLASS, LAMP, MIRROR, POINT, RED, SUN, build

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REN-3")


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        (
            {"ambient_light": (1.0, 1.0, 1.0), "materials": {"m": {"ambient": {"reflectance": (1.0, 1.0, 1.0)}}}},
            "ambient",
        ),
        (
            {"materials": {"m": {"specular": {"reflectance": (1.0, 1.0, 1.0), "exponent": 9.0, "model": "phong"}}}},
            "specular",
        ),
        ({"lights": [POINT | {"falloff": "none"}]}, "inverse square"),
        ({"lights": [POINT | {"falloff": {"constant": 1.0, "linear": 0.0, "quadratic": 1.0}}]}, "inverse square"),
        ({"convention": "whitted"}, "π"),
        ({"convention": "whitted", "materials": {"m": GLASS}}, "refraction"),
        (
            {
                "materials": {
                    "m": {
                        "dielectric": {
                            "index_of_refraction": 1.5,
                            "reflectance": (0.1, 0.1, 0.1),
                            "transmittance": (0.9, 0.9, 0.9),
                        }
                    }
                }
            },
            "Fresnel",
        ),
        (
            {"materials": {"m": {"dielectric": {"index_of_refraction": 1.5, "absorption": (0.0, 0.1, 0.0)}}}},
            "absorbing",
        ),
        ({"materials": {"m": RED | MIRROR}}, "blends"),
        ({"materials": {"m": RED | GLASS}}, "dielectric"),
        ({"materials": {"m": {"mirror": {"reflectance": (1.0, 1.01, 1.0)}}}}, "at most 1"),
        ({"materials": {"m": {"diffuse": {"reflectance": BOARD}}}, "objects": [FLOOR]}, "at most 1"),
        ({"materials": {"m": {"emission": {"radiance": BOARD}}}}, "sphere"),
    ],
)
def test_what_mitsuba_cannot_express_is_refused_with_its_reason(
    changes: dict[str, Any], word: str, tmp_path: Path
) -> None:
    scene = build(**changes)
    reason = refuses(scene)
    assert reason is not None
    assert word in reason
    with pytest.raises(ValueError, match=r"cannot be written for Mitsuba, because"):
        export_mitsuba(scene, tmp_path, max_depth=2)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "changes",
    [
        {"lights": [POINT, SUN]},
        {"convention": "whitted", "materials": {"m": MIRROR}},
        {"materials": {"m": GLASS}},
        {"materials": {"m": RED | LAMP}},
        {"materials": {"m": {"emission": {"radiance": BOARD}}}, "objects": [FLOOR]},
        {"materials": {"m": RED, "unused": RED | MIRROR}},
        {"materials": {"m": {"ambient": {"reflectance": (1.0, 1.0, 1.0)}} | RED}},
    ],
)
def test_what_mitsuba_can_express_is_not_refused(changes: dict[str, Any]) -> None:
    assert refuses(build(**changes)) is None


def test_an_absorbing_medium_that_only_the_camera_is_in_is_refused() -> None:
    fog = {"dielectric": {"index_of_refraction": 1.0, "absorption": (0.1, 0.2, 0.3)}}
    scene = build(materials={"m": RED, "fog": fog})
    inside = scene.model_copy(update={"camera": scene.camera.model_copy(update={"inside": "fog"})})
    assert refuses(scene) is None
    assert "absorbing" in (refuses(inside) or "")


def test_an_emissive_triangle_seen_from_both_sides_is_refused_and_from_behind_is_turned_around() -> None:
    materials = {"m": LAMP, "mirror": MIRROR}
    mirror_below = BALL | {"center": (0.0, -3.0, 0.0), "material": "mirror"}
    mirror_above = BALL | {"center": (0.0, 3.0, 0.0), "material": "mirror"}
    seen_from_behind = FLOOR | {"vertices": FLOOR["vertices"][::-1]}
    assert refuses(build(materials=materials, objects=[FLOOR, mirror_above])) is None
    assert "both sides" in (refuses(build(materials=materials, objects=[FLOOR, mirror_below])) or "")
    assert reversed_primitives(build(materials=materials, objects=[FLOOR, mirror_above])).tolist() == [False, False]
    turned = reversed_primitives(build(materials=materials, objects=[seen_from_behind, mirror_above]))
    assert turned.tolist() == [False, True]
