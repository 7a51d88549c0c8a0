"""All formats on the whole library, and what docs/exporting.md says of them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.scenes.exporters.formats import FORMATS
from raytruth.scenes.features import Feature
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.lights import PointLight
from raytruth.scenes.requirements import required_features, used_materials
from tests.scenes.exporter_scenes import BALL, BOARD, FLOOR, GLASS, LAMP, MIRROR, POINT, SUN, build

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-3", "PRJ-2")

DOCUMENT = (Path(__file__).parent.parent.parent / "docs" / "exporting.md").read_text(encoding="utf-8")

# What a refusal names, and whether a scene has it.
NAMED: dict[str, Callable[[Scene], bool]] = {
    "spheres": lambda scene: Feature.SPHERES in required_features(scene),
    "falls off": lambda scene: any(
        isinstance(light, PointLight) and light.falloff != "inverse_square" for light in scene.lights
    ),
    "polynomial": lambda scene: Feature.POLYNOMIAL_FALLOFF in required_features(scene),
    "ambient": lambda scene: Feature.AMBIENT in required_features(scene),
    "checkerboard": lambda scene: Feature.CHECKERBOARD in required_features(scene),
    "Phong": lambda scene: bool({Feature.PHONG, Feature.BLINN} & required_features(scene)),
    "π": lambda scene: scene.convention == "whitted" and any(material.diffuse for material in used_materials(scene)),
    "Fresnel": lambda scene: Feature.DIELECTRICS in required_features(scene),
    "mirror": lambda scene: Feature.MIRRORS in required_features(scene),
    "diffuse and a mirror term": lambda scene: any(m.diffuse and m.mirror for m in used_materials(scene)),
    "scales radiance": lambda scene: scene.convention == "whitted" and Feature.DIELECTRICS in required_features(scene),
    "outside": lambda scene: any(m.dielectric and m.dielectric.outside for m in used_materials(scene)),
    "gradient": lambda scene: Feature.BACKGROUND_GRADIENT in required_features(scene),
    "absorbing": lambda scene: Feature.ABSORPTION in required_features(scene),
    "area light": lambda scene: Feature.EMISSION in required_features(scene),
}


@pytest.mark.parametrize("format_name", FORMATS)
@pytest.mark.parametrize("name", library_names())
def test_each_scene_is_written_or_refused_with_what_it_has(name: str, format_name: str, tmp_path: Path) -> None:
    scene, form = open_scene(name), FORMATS[format_name]
    reason = form.refuses(scene)
    if reason is None:
        path = form.write(scene, tmp_path)
        assert path.stat().st_size > 0
        assert path.parent == tmp_path
        return
    words = [word for word in NAMED if word in reason]
    assert words, reason
    assert all(NAMED[word](scene) for word in words), reason
    with pytest.raises(ValueError, match="because"):
        form.write(scene, tmp_path)
    assert list(tmp_path.iterdir()) == []


CAMERA = {"position": (0.0, 1.0, 5.0), "look_at": (0.0, 0.0, 0.0), "width": 32, "height": 24}
ORTHOGRAPHIC = CAMERA | {"projection": "orthographic", "view_height": 3.0}
TILES = BOARD["checkerboard"] | {"even": (0.9, 0.1, 0.1)}
HIGHLIGHT = {"reflectance": (0.5, 0.5, 0.5), "exponent": 9.0}
WHITTED = {"convention": "whitted", "lights": [SUN]}
TETRAHEDRON = {
    "shape": "mesh",
    "vertices": ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "faces": ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)),
    "material": "m",
}


def solid(convention: str = "radiometric", **terms: Any) -> dict[str, Any]:
    dielectric = GLASS["dielectric"] | terms
    return {
        "convention": convention,
        "max_depth": 3,
        "objects": [TETRAHEDRON],
        "materials": {"m": {"dielectric": dielectric}},
    }


def material(**terms: Any) -> dict[str, Any]:
    return {"materials": {"m": terms}, "max_depth": 1}


AMBIENT = WHITTED | {"ambient_light": (1.0, 1.0, 1.0)} | material(ambient={"reflectance": (1.0, 1.0, 1.0)})


# Each row of the table: what a scene of one triangle has besides, and how a note names it that is left out.
ROWS: dict[str, tuple[dict[str, Any], str]] = {
    "triangles, meshes": ({}, "triangles"),
    "spheres": ({"objects": [BALL]}, "spheres"),
    "perspective camera": ({}, "camera"),
    "orthographic camera": ({"camera": ORTHOGRAPHIC}, "camera"),
    "image size, `max_depth`": ({}, "max_depth"),
    "constant background": ({"background": {"color": (0.1, 0.2, 0.3)}}, "background"),
    "gradient background": ({"background": {"bottom": (0.0, 0.0, 0.0), "top": (1.0, 1.0, 1.0)}}, "background"),
    "point light, `inverse_square`": ({"lights": [POINT]}, "lights"),
    "point light, other falloff": (
        {"lights": [POINT | {"falloff": "none"}], "convention": "whitted"} | material(**LAMP),
        "lights",
    ),
    "directional light": ({"lights": [SUN]}, "lights"),
    "diffuse, `radiometric`": ({"lights": [SUN]}, "diffuse"),
    "diffuse, `whitted`": (WHITTED, "diffuse"),
    "reflectance above 1": (material(diffuse={"reflectance": (0.5, 1.5, 0.5)}), "reflectance"),
    "diffuse checkerboard": (material(diffuse={"reflectance": {"checkerboard": TILES}}), "checkerboard"),
    "ambient light": (AMBIENT, "ambient light"),
    "ambient term": (AMBIENT, "ambient term"),
    "Phong's highlight": (WHITTED | material(specular=HIGHLIGHT | {"model": "phong"}), "highlight"),
    "Blinn's highlight": (WHITTED | material(specular=HIGHLIGHT | {"model": "blinn"}), "highlight"),
    "grey mirror": (material(**MIRROR), "mirror"),
    "coloured mirror": (material(mirror={"reflectance": (0.9, 0.5, 0.1)}), "mirror"),
    "glass, `radiometric`": (solid(), "glass"),
    "glass, `whitted`": (solid("whitted"), "glass"),
    "absorption": (solid(absorption=(0.1, 0.0, 0.0)), "absorption"),
    "constant weights": (solid("whitted", reflectance=(0.1, 0.1, 0.1), transmittance=(0.9, 0.9, 0.9)), "weights"),
    "emission": (material(**LAMP), "emission"),
    "emissive checkerboard": (material(emission={"radiance": BOARD}), "checkerboard"),
}


def cell(format_name: str, row: str) -> str:
    changes, word = ROWS[row]
    scene = build(**({"objects": [FLOOR]} | changes))
    form = FORMATS[format_name]
    if form.refuses(scene):
        return "refused"
    return "left out" if any(word in note and "left out" in note for note in form.notes(scene)) else "yes"


def test_the_table_says_what_each_format_can_say() -> None:
    head, _, *rows = re.findall(r"^\|.*\|$", DOCUMENT, flags=re.MULTILINE)
    table = [[entry.strip() for entry in row.strip("|").split("|")] for row in (head, *rows)]
    assert table[0][1:] == [f"`{name}`" for name in FORMATS]
    expected = [[row, *(cell(name, row) for name in FORMATS)] for row in ROWS]
    assert table[1:] == expected
