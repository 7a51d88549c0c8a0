"""What Cycles cannot express is refused, and nothing else."""

from __future__ import annotations

from typing import Any

import pytest

from raytruth.scenes.exporters.cycles_limits import refuses
from tests.scenes.exporter_scenes import BALL, FLOOR, GLASS, LAMP, MIRROR, POINT, RED, SUN, build
from tests.scenes.test_exporter_povray_limits import CAMERA, FACES, PARALLEL, TETRAHEDRON

pytestmark = pytest.mark.clause("REN-3")

FAR_BALL = BALL | {"center": (9.0, 9.0, 9.0)}
AROUND_CAMERA = BALL | {"center": (0.0, 1.5, 5.0)}


def glass(**changes: Any) -> dict[str, Any]:
    return {"materials": {"m": GLASS, "lamp": LAMP}, "max_depth": 2, "objects": [TETRAHEDRON]} | changes


def at_camera(x: float, z: float) -> dict[str, Any]:
    """A triangle across the axis of the camera, or beside it."""
    corners = [(x - 0.1, 0.9, 5.0 + z), (x + 0.1, 0.9, 5.0 + z), (x, 1.2, 5.0 + z)]
    return {"shape": "triangle", "vertices": corners, "material": "m"}


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"lights": [POINT | {"falloff": "none"}]}, "inverse square"),
        (
            {"ambient_light": (1.0, 1.0, 1.0), "materials": {"m": {"ambient": {"reflectance": (0.1, 0.1, 0.1)}}}},
            "ambient",
        ),
        (
            {"materials": {"m": {"specular": {"reflectance": (1.0, 1.0, 1.0), "exponent": 9.0, "model": "phong"}}}},
            "Phong's",
        ),
        ({"convention": "whitted"}, "π"),
        ({"materials": {"m": RED | MIRROR}}, "at random"),
        ({"materials": {"m": {"mirror": {"reflectance": (1.1, 0.0, 0.0)}}}}, "at most 1"),
        ({"materials": {"m": {"diffuse": {"reflectance": (1e-5, 1e-5, 9e-6)}}}}, "fainter"),
        ({"camera": CAMERA | {"width": 3}}, "4 pixels"),
        ({"camera": CAMERA | {"vertical_field_of_view": 178.0}}, "focal length"),
        ({"objects": [at_camera(0.0, -5e-7)]}, "nearer than 1e-06"),
        ({"objects": [at_camera(0.0, -5e-7)], "camera": PARALLEL}, "nearer than 1e-06"),
        ({"objects": [at_camera(1.0, -5e-7)], "camera": PARALLEL}, "nearer than 1e-06"),
        ({"objects": [BALL | {"center": (0.0, 1.0, 5.0 - 1.1 - 5e-7)}]}, "nearer than 1e-06"),
        ({"objects": [AROUND_CAMERA]}, "from outside only"),
        ({"objects": [BALL | {"center": (9.0, 1.0, 5.0)}], "camera": PARALLEL}, "from outside only"),
        (glass(objects=[BALL]), "sphere of glass"),
        (glass(objects=[FLOOR]), "scale radiance"),
        (glass(objects=[TETRAHEDRON | {"faces": FACES[1:]}]), "scale radiance"),
        (glass(objects=[TETRAHEDRON, BALL | {"material": "lamp"}]), "scale radiance"),
        (glass(camera=CAMERA | {"inside": "m"}), "scale radiance"),
        (glass(materials={"m": {"dielectric": {"index_of_refraction": 1001.0}}}), "at most 1000"),
        (glass(materials={"m": {"dielectric": GLASS["dielectric"] | {"absorption": (1.0, 0.0, 0.0)}}}), "volumes"),
        (
            glass(
                materials={
                    "m": {
                        "dielectric": {
                            "index_of_refraction": 1.5,
                            "reflectance": (0.1, 0.1, 0.1),
                            "transmittance": (0.9, 0.9, 0.9),
                        }
                    }
                }
            ),
            "constant weights",
        ),
    ],
)
def test_what_cycles_cannot_express_is_refused_with_its_reason(changes: dict[str, Any], word: str) -> None:
    reason = refuses(build(**changes))
    assert reason is not None
    assert word in reason


@pytest.mark.parametrize(
    "changes",
    [
        {"lights": [POINT, SUN]},
        {"materials": {"m": RED | LAMP}},
        {"materials": {"m": MIRROR | LAMP}},
        {"camera": PARALLEL},
        {"objects": [at_camera(1.0, -5e-7)]},  # beside what is seen
        {"objects": [at_camera(0.0, -5e-3)]},
        {"objects": [at_camera(0.0, 5e-3)]},  # behind the camera
        {"materials": {"m": {"diffuse": {"reflectance": (0.0, 0.0, 0.0)}}}},
        glass(objects=[TETRAHEDRON, FAR_BALL | {"material": "lamp"}]),
        glass(convention="whitted", objects=[FLOOR, BALL | {"material": "lamp"}]),
    ],
)
def test_what_it_can_express_is_not(changes: dict[str, Any]) -> None:
    assert refuses(build(**changes)) is None
