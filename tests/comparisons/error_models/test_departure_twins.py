"""Departures against what they must come to: the truth of another scene, another formula, or a fault of the catalogue.

Each image here is made without the departure's own code, and has to be feasible for who declares it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.departures import Departures
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.records.results import Verdict
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, Behaviour
from raytruth.reference_tracer.rendering import first_hits, prepare, render
from tests.comparisons.departing_tracers import BOARD, HIGHLIGHT, SCENES, SIZE, judged
from tests.reference_tracer.small_scenes import lamp, small_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-16")

# Other formulas for the same lose some bits.
BITS = 39
OFFSET = 0.125


def image(scene: Scene, behaviour: Behaviour = IDEAL) -> NDArray[np.float64]:
    return np.asarray(render(scene, FLOAT, behaviour), dtype=np.float64)


def verdict(pixels: NDArray[np.float64], scene: Scene, departures: Departures, offset: float = 0.0) -> Verdict:
    model = ErrorModel("a twin", BITS, RayOffset(absolute=offset), departures=departures)
    return judged(pixels.astype(np.float32), scene, model)[0]


def lit_sphere(light: tuple[float, float, float], board: dict[str, Any]) -> Scene:
    materials = {"white": {"diffuse": {"reflectance": {"checkerboard": board}}}}
    return small_scene(**SIZE, materials=materials, lights=[lamp(light)])


@pytest.mark.parametrize(
    ("fault", "scene_name", "departures"),
    [
        ("background_where_paths_end", "sky", Departures(end_of_depth="background")),
        ("schlick", "glass", Departures(fresnel="schlick")),
        ("schlick_by_the_incident_cosine", "glass", Departures(fresnel="schlick on the incident side")),
    ],
)
def test_a_fault_that_is_declared_as_a_departure_is_declared(
    fault: str, scene_name: str, departures: Departures
) -> None:
    wrong = Behaviour(all_faults()[fault].overrides)
    assert verdict(image(SCENES[scene_name], wrong), SCENES[scene_name], departures) == Verdict.DECLARED


def test_local_terms_at_the_end_are_the_truth_of_one_more_bounce() -> None:
    scene = SCENES["mirrors"]
    deeper = scene.model_copy(update={"max_depth": scene.max_depth + 1})
    assert verdict(image(deeper), scene, Departures(end_of_depth="local")) == Verdict.DECLARED


def test_constant_weights_are_those_that_a_material_may_state() -> None:
    def glass(**weights: Any) -> Scene:
        dielectric = {"index_of_refraction": 1.5, **weights}
        sky = {"bottom": (0.1, 0.2, 0.3), "top": (0.9, 0.8, 0.7)}
        return small_scene(**SIZE, materials={"white": {"dielectric": dielectric}}, background=sky, max_depth=3)

    stated = glass(reflectance=(0.25,) * 3, transmittance=(0.5,) * 3)
    assert verdict(image(stated), glass(), Departures(constant_weights=(0.25, 0.5))) == Verdict.DECLARED


def test_a_sphere_is_lit_from_beside_it_as_by_a_light_that_is_nearer_by_as_much() -> None:
    # From (1 + δ)·p a light at l is in the same direction as one at l/(1 + δ) is from p.
    light = (1.0, 2.0, 4.0)
    nearer = tuple(coordinate / (1 + OFFSET) for coordinate in light)
    twin = image(lit_sphere((nearer[0], nearer[1], nearer[2]), BOARD))
    assert verdict(twin, lit_sphere(light, BOARD), Departures(lit_from="offset point"), OFFSET) == Verdict.DECLARED


def test_a_sphere_has_beside_it_the_texture_that_is_smaller_by_as_much() -> None:
    smaller = BOARD | {
        "size": BOARD["size"] / (1 + OFFSET),
        "offset": tuple(part / (1 + OFFSET) for part in BOARD["offset"]),
    }
    light = (1.0, 2.0, 4.0)
    twin = image(lit_sphere(light, smaller))
    departures = Departures(textured_at="offset point")
    assert verdict(twin, lit_sphere(light, BOARD), departures, OFFSET) == Verdict.DECLARED


def test_highlights_in_shadows_are_those_without_what_throws_them() -> None:
    scene = SCENES["shadow"]
    (material,) = scene.materials.values()
    diffuse, specular = ({"white": material.model_copy(update={term: None})} for term in ("specular", "diffuse"))
    shaded = image(scene.model_copy(update={"materials": diffuse}))
    # The highlight of each object by itself, where it is the one that the camera sees; spheres are numbered first.
    highlights = [
        image(scene.model_copy(update={"materials": specular, "objects": (shape,)})) for shape in scene.objects
    ]
    _, seen = first_hits(prepare(scene, FLOAT))
    is_sphere = seen == 0
    twin = shaded + np.where(is_sphere[..., np.newaxis], highlights[1], highlights[0])
    found = verdict(twin, scene, Departures(highlights="shadowed"))
    assert found == Verdict.DECLARED


def sphere_of_formulas(width: int, height: int, extent: float, light: NDArray[np.float64]) -> NDArray[np.float64]:
    """A unit sphere in the middle seen along -z by parallel rays: kd·max(n·l, 0) + ks·max(r·l, 0)², lit or not."""
    pixel = extent / height
    x, y = np.meshgrid((np.arange(width) + 0.5 - width / 2) * pixel, (height / 2 - 0.5 - np.arange(height)) * pixel)
    hit = x * x + y * y < 1
    normal = np.stack([x, y, np.sqrt(np.where(hit, 1 - x * x - y * y, 0.0))], axis=2)
    to_light = light - normal
    to_light /= np.linalg.norm(to_light, axis=2, keepdims=True)
    mirrored = 2 * normal[..., 2:] * normal - np.array([0.0, 0.0, 1.0])
    diffuse = np.maximum((normal * to_light).sum(axis=2), 0.0)
    highlight = np.maximum((mirrored * to_light).sum(axis=2), 0.0) ** HIGHLIGHT["exponent"]
    color = diffuse[..., np.newaxis] * (0.4, 0.3, 0.2) + highlight[..., np.newaxis] * HIGHLIGHT["reflectance"]
    return np.where(hit[..., np.newaxis], color, 0.0)


def test_highlights_everywhere_are_on_sides_that_are_turned_away() -> None:
    twin = sphere_of_formulas(**SIZE, light=np.array([3.0, 0.0, -1.0]))
    assert verdict(twin, SCENES["behind"], Departures(highlights="everywhere")) == Verdict.DECLARED


def test_the_light_of_all_lamps_is_clamped_together_before_it_is_reflected() -> None:
    def lamps(brightness: float, count: int) -> Scene:
        sun = {"kind": "directional", "direction": (0.0, 0.0, -1.0), "irradiance": (brightness,) * 3}
        return small_scene(**SIZE, lights=[sun] * count)

    scene = lamps(0.75, 2)
    lambert = image(lamps(1.5, 1))  # of a white sphere it is the sum itself
    twin = np.minimum(lambert, 1.0)
    assert (twin != lambert).any()
    assert verdict(twin, scene, Departures(clamped_lambert=True)) == Verdict.DECLARED
