"""Small whole scenes of ties that certification once left undecided, each against a closed form of its own."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.certified_image import certified_image
from raytruth.reference_tracer.explanation import explain
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.reference_tracer.certified_image import CertifiedImage
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-5")


@pytest.fixture(autouse=True)
def _cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))


def tie_scene(name: str) -> Scene:
    return open_scene(str(Path(__file__).parent / "tie_scenes" / f"{name}.json"))


def decided(name: str) -> tuple[Scene, CertifiedImage]:
    """The scene, and its certified image, in which nothing is undecided or wide."""
    scene = tie_scene(name)
    image = certified_image(scene)
    assert image.undecided == {}
    assert image.radius.max() <= 2.0**-52 * max(1.0, image.middle.max())
    return scene, image


def floor_points(scene: Scene) -> NDArray[np.float64]:
    """Where the perspective camera's rays meet the plane y = 0; NaN above the horizon. Shape (height, width, 3)."""
    camera = scene.camera
    position = np.array(camera.position)
    forward = np.array(camera.look_at) - position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, camera.up)
    right /= np.linalg.norm(right)
    step = 2 * math.tan(math.radians(camera.vertical_field_of_view) / 2) / camera.height  # type: ignore[union-attr]
    x = (np.arange(camera.width) + 0.5 - camera.width / 2) * step
    y = (np.arange(camera.height) + 0.5 - camera.height / 2) * step
    rays = forward + x[None, :, None] * right + y[:, None, None] * np.cross(forward, right)
    distance = np.where(rays[..., 1] < 0, -position[1] / rays[..., 1], np.nan)
    points: NDArray[np.float64] = position + distance[..., None] * rays
    return points


def lit_tiles(scene: Scene, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """What the checkerboard of squares of 0.7 shows of the scene's one lamp, if nothing hides it."""
    light = scene.lights[0]
    tiles = scene.materials["tiles"].diffuse.reflectance.checkerboard  # type: ignore[union-attr]
    number = np.floor(points[..., 0] / 0.7) + np.floor(points[..., 2] / 0.7)
    colour = np.where((number % 2 == 0)[..., None], tiles.even, tiles.odd)
    toward = np.array(light.position) - points  # type: ignore[union-attr]
    squared = (toward**2).sum(axis=-1)
    arriving = light.intensity[0] * toward[..., 1] / np.sqrt(squared) / squared / math.pi  # type: ignore[union-attr]
    lit: NDArray[np.float64] = colour * arriving[..., None]
    return lit


def passes_sphere(
    start: NDArray[np.float64], end: NDArray[np.float64], center: list[float], radius: float
) -> NDArray[np.bool_]:
    """Which segments keep away from a sphere."""
    way = end - start
    part = np.clip(((center - start) * way).sum(axis=-1) / (way**2).sum(axis=-1), 0, 1)
    nearest = start + part[..., None] * way - center
    away: NDArray[np.bool_] = (nearest**2).sum(axis=-1) > radius**2
    return away


@pytest.mark.clause("TRI-1", "TRI-3")
def test_a_floor_seen_along_its_shared_edge_has_one_value_at_each_pixel() -> None:
    scene, image = decided("floor-seen-along-its-shared-edge")
    points = floor_points(scene)
    camera, light = np.array(scene.camera.position), np.array(scene.lights[0].position)  # type: ignore[union-attr]
    sphere = ([0.4, 0.5, 0.3], 0.5)
    seen = passes_sphere(camera, points, *sphere)
    lit = passes_sphere(points, light, *sphere)
    expected = lit_tiles(scene, points) * lit[..., None]
    np.testing.assert_allclose(image.middle[seen], expected[seen], rtol=1e-13)
    on_edge = np.isclose(points[..., 0], -points[..., 2])
    assert (on_edge & seen).sum() > 15


@pytest.mark.clause("SHAD-1", "ILL-2")
def test_a_light_in_the_plane_of_a_floor_leaves_it_black() -> None:
    _, image = decided("light-in-the-plane-of-a-floor")
    assert image.middle.max() == 0.0
    assert image.radius.max() == 0.0


@pytest.mark.clause("REFR-2", "REFR-8")
def test_a_pythagorean_ray_at_exactly_the_critical_angle_is_reflected_in_full() -> None:
    _, image = decided("critical-angle-of-a-pythagorean-ray")
    assert (image.middle == (0.25, 0.5, 0.75)).all()


@pytest.mark.clause("SHAD-1", "TRI-2")
def test_a_light_at_the_corner_of_a_box_is_hidden_by_the_box_but_not_by_that_corner() -> None:
    scene, image = decided("light-at-the-corner-of-a-box")
    points = floor_points(scene)
    # Seen from x = 0, the box fills x >= 0 up to its edges at y = 1, z = 0 and x = 1, z = 1; all its seen sides are
    # in one plane with the light, and so black.
    camera = np.array(scene.camera.position)
    way = points - camera
    enters = np.maximum.reduce([-camera[0] / way[..., 0], (1 - camera[1]) / way[..., 1], (1 - camera[2]) / way[..., 2]])
    leaves = np.minimum.reduce([(1 - camera[0]) / way[..., 0], np.full(way.shape[:2], 1.0), -camera[2] / way[..., 2]])
    floor = (np.abs(points) <= 5).all(axis=-1)
    on_box = floor & (way[..., 0] > 0) & (enters < leaves)
    lit = (points[..., 0] > 1) | (points[..., 2] > 1)
    expected = np.where((lit & ~on_box)[..., None], lit_tiles(scene, points), 0.0)
    np.testing.assert_allclose(image.middle[floor], expected[floor], rtol=1e-12)
    assert (floor & ~on_box & ~lit).sum() > 50
    assert on_box.sum() > 20


@pytest.mark.clause("ILL-9")
def test_a_light_at_a_seen_point_is_black_there_in_truth_explanation_and_floats() -> None:
    scene, image = decided("light-at-a-seen-point")
    assert image.middle.max() == 0.0  # everywhere else it lies in the floor's plane
    assert explain(scene, 12, 12).sum == (0.0, 0.0, 0.0)
    assert not render(scene, FLOAT).astype(np.float64).any()
