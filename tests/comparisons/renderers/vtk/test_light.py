"""VTK's own light agrees with the classical equation where it is not refused, and faults in it are caught."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.matrix.comparability import depth_or_reason
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.vtk import adapter
from raytruth.comparisons.renderers.vtk.adapter import LOCAL, Vtk
from raytruth.comparisons.renderers.vtk.light import (
    LARGEST_EXPONENT,
    LEAST_EXPONENT,
    MOST_LIGHTS,
    lamps_of,
    refused_light,
    surfaces_of,
)
from raytruth.scenes.library import open_scene
from tests.comparisons.drawn_triangles import PERSPECTIVE
from tests.comparisons.lit_triangles import (
    BEHIND,
    CAMERA,
    DULL,
    FADING,
    LEFT,
    NEAR,
    PARALLEL,
    POINT,
    RIGHT,
    SHINY,
    SUN,
    head_lit,
    plates,
    radiometric_plates,
)
from tests.comparisons.renderers.vtk.vtk_cells import cell_of, expectation_for, needs_vtk
from tests.scenes.exporter_scenes import BALL, BOARD, GLASS, MIRROR, build

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.judgement.verdict import Expectation
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-4")

# What it reflects of the light that a floor hides from it.
ROOF = {"shape": "triangle", "vertices": ((-1.0, 0.6, 0.3), (0.9, 0.6, 0.5), (0.1, 0.6, -0.9)), "material": "m"}
FLOOR = {
    "shape": "mesh",
    "vertices": ((-29.0, -1.1, -19.0), (-29.0, -1.1, 19.0), (29.0, -1.1, 19.0), (29.0, -1.1, -19.0)),
    "faces": ((0, 1, 2), (0, 2, 3)),
    "material": "m",
}
LIT = {
    "plates": plates(),
    "one lamp": plates(lights=[POINT]),
    "a sun alone": plates(lights=[SUN]),
    "the dark": plates(lights=[]),
    "physical light": radiometric_plates(CAMERA),
    "parallel rays": radiometric_plates(PARALLEL),
    "parallel rays, whitted": plates(camera=PARALLEL, materials={"m": DULL, "n": DULL}),
    "a floor that is cut": build(objects=[FLOOR], lights=[NEAR, SUN]),
    "many edges": head_lit(0, PERSPECTIVE),
    "more edges": head_lit(1, PERSPECTIVE),
}


@needs_vtk
@pytest.mark.parametrize("name", LIT)
def test_light_that_vtk_has_passes(name: str, tmp_path: Path) -> None:
    scene = LIT[name]
    assert depth_or_reason(scene, Vtk(), LOCAL) == 0
    cell = cell_of(scene, "local", tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason
    assert cell.judgement is not None
    assert cell.judgement.unjudged == 0


@needs_vtk
@pytest.mark.parametrize("name", ["cornell-box", "plates-lit-from-behind"])
def test_a_scene_of_the_library_passes_in_other_light(name: str, tmp_path: Path) -> None:
    whole = open_scene(name)
    light = NEAR | {"position": whole.camera.position}
    camera = whole.camera.model_dump() | {"width": 32, "height": 24}
    materials = dict.fromkeys(whole.materials, DULL)
    scene = build(**(whole.model_dump() | {"lights": [light], "camera": camera, "materials": materials}))
    cell = cell_of(scene, "local", tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason


@needs_vtk
def test_the_order_of_corners_does_not_matter(tmp_path: Path) -> None:
    turned = [shape | {"vertices": shape["vertices"][::-1]} for shape in (LEFT, RIGHT)]
    cell = cell_of(plates(objects=turned), "local", tmp_path)
    assert cell.verdict == Verdict.PASS, cell.reason


@pytest.fixture(scope="module")
def expectation() -> dict[str, Expectation]:
    return {name: expectation_for(LIT[name], with_colors=True) for name in ("plates", "physical light")}


Parts = tuple[tuple[Any, ...], tuple[Any, ...]]


def brighter(surfaces: Any, lamps: Any) -> Parts:
    first, *others = lamps
    return surfaces, (first.model_copy(update={"color": tuple(1.001 * value for value in first.color)}), *others)


def sharper(surfaces: Any, lamps: Any) -> Parts:
    return tuple(s.model_copy(update={"exponent": 1.01 * s.exponent}) for s in surfaces), lamps


def without_ambient(surfaces: Any, lamps: Any) -> Parts:
    return tuple(s.model_copy(update={"ambient": (0.0, 0.0, 0.0)}) for s in surfaces), lamps


def moved(surfaces: Any, lamps: Any) -> Parts:
    first, *others = lamps
    x, y, z = first.position
    return surfaces, (first.model_copy(update={"position": (x, y, 1.001 * z)}), *others)


def without_falloff(surfaces: Any, lamps: Any) -> Parts:
    return surfaces, tuple(lamp.model_copy(update={"attenuation": (1.0, 0.0, 0.0)}) for lamp in lamps)


def reversed_suns(surfaces: Any, lamps: Any) -> Parts:
    return surfaces, tuple(
        lamp.model_copy(update={"direction": tuple(-value for value in lamp.direction)}) for lamp in lamps
    )


def without_the_last_lamp(surfaces: Any, lamps: Any) -> Parts:
    return surfaces, lamps[:-1]


def without_pi(surfaces: Any, lamps: Any) -> Parts:
    return tuple(s.model_copy(update={"diffuse": tuple(math.pi * v for v in s.diffuse)}) for s in surfaces), lamps


FAULTS = [
    ("plates", brighter),
    ("plates", sharper),
    ("plates", without_ambient),
    ("plates", moved),
    ("plates", without_falloff),
    ("plates", reversed_suns),
    ("plates", without_the_last_lamp),
    ("physical light", brighter),
    ("physical light", moved),
    ("physical light", without_falloff),
    ("physical light", without_pi),
]


@needs_vtk
@pytest.mark.clause("VER-3")
@pytest.mark.parametrize(("name", "fault"), FAULTS)
def test_a_fault_in_the_light_fails(
    name: str,
    fault: Callable[[Any, Any], Parts],
    expectation: dict[str, Expectation],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    surfaces, numbers = surfaces_of(LIT[name])
    faulty_surfaces, faulty_lamps = fault(surfaces, lamps_of(LIT[name]))
    monkeypatch.setattr(adapter, "surfaces_of", lambda _: (faulty_surfaces, numbers))
    monkeypatch.setattr(adapter, "lamps_of", lambda _: faulty_lamps)
    assert cell_of(LIT[name], "local", tmp_path, expectation[name]).verdict == Verdict.FAIL


@needs_vtk
@pytest.mark.clause("VER-3")
@pytest.mark.parametrize("clipped_to", [0.0, 1.0])
def test_a_wrong_pixel_and_a_clipped_picture_fail(
    clipped_to: float, expectation: dict[str, Expectation], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = adapter._run

    def faulty(*arguments: Any) -> Any:
        image = right(*arguments)["image"].copy()
        image[12, 8] *= 1.002
        return right(*arguments) | {"image": np.minimum(image, clipped_to) if clipped_to else image}

    monkeypatch.setattr(adapter, "_run", faulty)
    cell = cell_of(LIT["plates"], "local", tmp_path, expectation["plates"])
    assert cell.verdict == Verdict.FAIL
    assert cell.judgement is not None
    assert cell.judgement.failing == 1 or clipped_to


def shadowed() -> Scene:
    above = POINT | {"position": (0.1, 3.3, 0.4)}
    return build(objects=[ROOF, FLOOR], lights=[above], convention="whitted")


@needs_vtk
def test_a_shadow_that_vtk_lacks_is_refused_and_would_fail(tmp_path: Path) -> None:
    assert "throws no shadows, and triangle 0 may hide light 0 from triangle 1" in str(refused_light(shadowed()))
    assert cell_of(shadowed(), "local", tmp_path).verdict == Verdict.FAIL


def shiny(**specular: Any) -> dict[str, Any]:
    return {"m": SHINY | {"specular": SHINY["specular"] | specular}, "n": DULL}


def test_light_that_vtk_lacks_is_refused() -> None:
    reasons = {
        "Phong's": plates(materials=shiny(model="blinn")),
        "1.44": plates(materials=shiny(exponent=0.99 * LEAST_EXPONENT)),
        "to 128": plates(materials=shiny(exponent=1.01 * LARGEST_EXPONENT)),
        "camera's position": plates(camera=PARALLEL),
        "place in the picture": plates(background={"bottom": (0.1, 0.1, 0.1), "top": (0.2, 0.3, 0.4)}),
        "checkerboard": plates(materials={"m": {"emission": {"radiance": BOARD}}, "n": DULL}),
        "too long to compile": plates(lights=[POINT] * (MOST_LIGHTS + 1)),
        "may brighten": plates(lights=[FADING | {"falloff": {"constant": 0.1, "linear": 0.1, "quadratic": 0.01}}]),
        "no spheres": build(objects=[BALL]),
        "light paths ES": plates(materials={"m": MIRROR, "n": DULL}, max_depth=2, lights=[BEHIND]),
    }
    for reason, scene in reasons.items():
        assert reason in str(depth_or_reason(scene, Vtk(), LOCAL)), reason


@pytest.mark.parametrize("weights", [(1, 0, 0), (0, 0.5, 0.5), (0.25, 0.25, 0.5), (0.2, 0.3, 0.5)])
def test_a_light_in_a_surface_is_refused_and_one_beside_it_is_not(weights: tuple[float, float, float]) -> None:
    """Of the direction to it VTK would make 0/0."""
    place = np.array(weights) @ np.array(LEFT["vertices"])
    inside = plates(lights=[SUN, POINT | {"position": tuple(place.tolist())}])
    assert "light 1 may be in a surface" in str(depth_or_reason(inside, Vtk(), LOCAL))
    beside = plates(lights=[SUN, POINT | {"position": tuple((place + np.array((0, 0, 0.01))).tolist())}])
    assert "may be in" not in str(refused_light(beside))


def test_what_makes_no_difference_is_not_refused() -> None:
    assert refused_light(plates(materials=shiny(model="blinn"), lights=[])) is None
    assert (
        refused_light(plates(lights=[FADING | {"falloff": {"constant": 0.1, "linear": 0.1, "quadratic": 0.2}}])) is None
    )
    unused = {"m": DULL, "n": DULL, "glass": GLASS}
    assert refused_light(plates(materials=unused)) is None


def test_in_the_dark_no_surface_has_a_diffuse_colour() -> None:
    """VTK shows it as it is where there is no light."""
    surfaces, numbers = surfaces_of(LIT["the dark"])
    assert [surface.diffuse for surface in surfaces] == [(0.0, 0.0, 0.0)] * 2
    assert numbers.tolist() == [0, 1]
    assert surfaces[0].ambient == pytest.approx((0.31 * 0.7 + 0.07, 0.17 * 0.9, 0.11 * 1.3 + 0.19))
