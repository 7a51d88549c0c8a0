"""What VTK's formulas give in float32 lies in the feasible sets of its model; other light does not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.error_models.rasterisers.rasterised_light import LEAST_COSINE
from raytruth.comparisons.error_models.rasterisers.view_volume import camera_axes
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import judge_image
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.rendering import render
from raytruth.reference_tracer.source.reflection import mirror_direction
from raytruth.reference_tracer.source.traversal import surface_normal
from raytruth.reference_tracer.source.vector import add, along, dot, scale
from raytruth.scenes.exporters.triangle_soup import material_of_each_triangle, triangles_of_scene
from tests.comparisons.drawn_triangles import F, drawn, drawn_positions
from tests.comparisons.lit_triangles import BEHIND, CAMERA, PARALLEL, SUN, plates, radiometric_plates

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2", "ILL-1", "ILL-2", "ILL-5")

MODEL = ErrorModel("", 24, rasterisation=Rasterisation(subpixel_bits=8, depth_bits=24, light_bits=22))
SCENES = {
    "plates": plates(lights=[BEHIND | {"position": (0.4, 1.7, 3.1)}, BEHIND, SUN]),
    "physical light": radiometric_plates(CAMERA),
    "parallel rays": radiometric_plates(PARALLEL),
}


@pytest.fixture(scope="module")
def feasible() -> dict[str, FeasibleSet]:
    return {name: feasible_set(scene, MODEL) for name, scene in SCENES.items()}


def failing(image: Any, feasible: FeasibleSet) -> int:
    picture = np.array(image, dtype=np.float64)
    return judge_image(picture.astype(np.float32), picture, feasible)[0].failing


def unit(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    lengths = np.sqrt((vectors * vectors).sum(axis=-1, keepdims=True, dtype=F))
    return np.asarray(vectors / lengths)


def drawn_light(scene: Scene) -> NDArray[np.float32]:
    """The picture of VTK's formulas, all in float32 and view coordinates, z forward."""
    axes = np.array(camera_axes(scene))
    hits = drawn(scene)
    image = np.broadcast_to(np.array(scene.background.color, dtype=F), (*hits.depth.shape, 3)).copy()
    xs, ys = np.meshgrid(*(np.arange(side, dtype=F) for side in (scene.camera.width, scene.camera.height)))
    for number, (a, b, c) in enumerate(triangles_of_scene(scene)):
        positions = drawn_positions(scene, number, xs, ys)
        normal = unit((axes.astype(F) @ np.cross(b - a, c - a).astype(F)).astype(F))
        seen_along = (
            (axes @ (a - scene.camera.position))
            if scene.camera.projection == "perspective"
            else np.array([0.0, 0.0, 1.0])
        )
        material = scene.materials[material_of_each_triangle(scene)[number]]
        color = shaded(scene, material, positions, -normal if seen_along @ normal > 0 else normal, axes)
        image[hits.primitive == number] = color[hits.primitive == number]
    return image


def shaded(scene: Scene, material: Any, positions: Any, normal: Any, axes: Any) -> NDArray[np.float32]:
    color = np.zeros_like(positions)
    if material.emission:
        color += np.array(material.emission.radiance, dtype=F)
    if material.ambient:
        color += np.multiply(material.ambient.reflectance, scene.ambient_light).astype(F)
    diffuse = np.array(material.diffuse.reflectance) / (np.pi if scene.convention == "radiometric" else 1)
    for light in scene.lights:
        if light.kind == "directional":
            toward = np.broadcast_to(-unit((axes @ np.array(light.direction)).astype(F)), positions.shape)
            attenuation, arriving = np.ones((*positions.shape[:2], 1), dtype=F), np.array(light.irradiance, dtype=F)
        else:
            to_light = (axes @ np.subtract(light.position, scene.camera.position)).astype(F) - positions
            toward = unit(to_light)
            distance = np.sqrt((to_light * to_light).sum(axis=-1, keepdims=True, dtype=F))
            attenuation = F(1) / (distance * distance) if light.falloff == "inverse_square" else np.ones_like(distance)
            arriving = np.array(light.intensity, dtype=F)
        cosine = (toward @ normal)[..., np.newaxis]
        lit = np.maximum(cosine, F(0)) * diffuse.astype(F)
        if material.specular:
            mirrored = (F(2) * cosine * normal - toward).astype(F)
            seen = np.maximum((mirrored * unit(-positions)).sum(axis=-1, keepdims=True, dtype=F), F(LEAST_COSINE))
            highlight = np.where(cosine > 0, seen ** F(material.specular.exponent), F(0))
            lit = lit + highlight * np.array(material.specular.reflectance, dtype=F)
        color = color + attenuation * lit * arriving
    return np.asarray(color.astype(F))


@pytest.mark.parametrize("name", SCENES)
def test_float32_light_is_feasible_and_every_pixel_judged(name: str, feasible: dict[str, FeasibleSet]) -> None:
    assert failing(drawn_light(SCENES[name]), feasible[name]) == 0
    assert feasible[name].outcomes.min() > 0
    assert (feasible[name].outcomes > 1).mean() < 0.1


@pytest.mark.parametrize("name", SCENES)
def test_the_truth_is_feasible(name: str, feasible: dict[str, FeasibleSet]) -> None:
    assert failing(render(SCENES[name], FLOAT), feasible[name]) == 0


def unturned_surface(scene: Any, origin: Any, direction: Any, distance: Any, primitive: int) -> Any:
    point = along(origin, direction, distance)
    outward = surface_normal(scene, primitive, point)
    return point, outward, dot(direction, outward) < 0.0


def a_little_more_light(
    scene: Any,  # noqa: ARG001 - the signature of the function it stands for
    material: int,  # noqa: ARG001 - as above
    point: Any,  # noqa: ARG001 - as above
) -> Any:
    return (0.43043, 0.61, 0.29)


def sharper_phong(normal: Any, direction: Any, toward_light: Any, exponent: Any) -> Any:
    return max(dot(mirror_direction(direction, normal), toward_light), 0.0) ** (exponent * 1.01)


def halfway_phong(normal: Any, direction: Any, toward_light: Any, exponent: Any) -> Any:
    halfway = add(toward_light, scale(direction, -1.0))
    cosine = dot(normal, scale(halfway, 1.0 / dot(halfway, halfway) ** 0.5))
    return max(cosine, 0.0) ** exponent


def no_light(*arguments: Any) -> Any:  # noqa: ARG001 - as above
    return (0.0, 0.0, 0.0)


@pytest.mark.clause("VER-3")
@pytest.mark.parametrize(
    ("function", "fault"),
    [
        ("surface_at", unturned_surface),
        ("diffuse", a_little_more_light),
        ("phong", sharper_phong),
        ("phong", halfway_phong),
        ("ambient", no_light),
        ("emission", no_light),
    ],
)
def test_a_fault_of_a_tracer_fails(function: str, fault: Any, feasible: dict[str, FeasibleSet]) -> None:
    assert failing(render(SCENES["plates"], FLOAT, Behaviour({function: fault})), feasible["plates"]) > 10


@pytest.mark.clause("VER-3")
@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("factor", [0.999, 1.001])
def test_a_thousandth_of_the_light_fails(name: str, factor: float, feasible: dict[str, FeasibleSet]) -> None:
    image = drawn_light(SCENES[name])
    assert failing(image * F(factor), feasible[name]) > image[..., 0].size / 5


def test_the_truth_s_own_shadows_are_kept() -> None:
    roof = {"shape": "triangle", "vertices": ((-2.0, 1.0, 0.5), (2.0, 1.0, 0.5), (0.0, 1.0, -2.0)), "material": "m"}
    shadowed = plates(
        objects=[*SCENES["plates"].model_dump()["objects"], roof], lights=[SUN | {"direction": (0.0, -1.0, -0.1)}]
    )
    own = feasible_set(shadowed, MODEL)
    assert failing(render(shadowed, FLOAT), own) == 0
    assert failing(drawn_light(shadowed), own) > 10
