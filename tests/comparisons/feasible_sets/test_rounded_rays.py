"""Where a pixel's ray may go, and what a renderer stores in place of the scene's numbers."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation
from raytruth.comparisons.feasible_sets.rounded_rays import LinkedRays, PlainRays
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.arithmetics.linked_balls import enclosure
from raytruth.reference_tracer.rendering import prepare
from raytruth.reference_tracer.source.scene_data import MATERIAL_INDEX, MATERIAL_OUTSIDE_INDEX, number_of
from raytruth.scenes.library import open_scene
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


@pytest.mark.parametrize(("way", "ball_of"), [(PlainRays, lambda ball: ball), (LinkedRays, enclosure)])
def test_indices_of_refraction_have_the_bits_that_are_declared(way: Any, ball_of: Any) -> None:
    scene = open_scene("total-reflection-prism")  # of index 1.5, which is exact
    other = open_scene("glass-sphere")
    dielectric = other.materials["glass"].dielectric
    assert dielectric is not None
    index = dielectric.index_of_refraction
    for bits, stored in ((24, float(np.float32(index))), (None, index)):
        model = ErrorModel("", 45, index_bits=bits)
        data = way(other, model).prepared.data
        ball = ball_of(number_of(data, MATERIAL_INDEX, 0))
        assert ball.contains(stored)
        assert float(ball.rad()) <= index * 2.0**-44  # the roundoff of all numbers
        assert ball_of(number_of(data, MATERIAL_OUTSIDE_INDEX, 0)) == 1
        assert ball_of(number_of(way(scene, model).prepared.data, MATERIAL_INDEX, 0)) == 1.5


@pytest.mark.parametrize(("way", "ball_of"), [(PlainRays, lambda ball: ball), (LinkedRays, enclosure)])
@pytest.mark.parametrize("name", ["sphere-over-floor", "parallel-projection"])
def test_a_pixels_ray_stands_for_all_rays_within_the_image_radius(way: Any, ball_of: Any, name: str) -> None:
    scene = open_scene(name)
    column, row, radius = 7, 5, 0.25
    rays = way(scene, ErrorModel("", 24, image_radius=radius))
    put_in_force(rays.prepared.arithmetic)
    balls = [ball_of(number) for vector in rays.primary_ray(column, row) for number in vector]
    exact = prepare(scene, FLOAT)
    frame = exact.kernel.camera_frame(exact.data)
    inside = [[] for _ in balls]
    for x, y in itertools.product((-radius, 0.0, radius), repeat=2):
        through = exact.kernel.primary_ray(frame, column + 0.5 + x, row + 0.5 + y)
        numbers = [number for vector in through for number in vector]
        assert all(ball.contains(number) for ball, number in zip(balls, numbers, strict=True))
        for values, number in zip(inside, numbers, strict=True):
            values.append(number)
    # Nor does it stand for many others: what depends on x and y alike is no more than a few times too wide.
    assert any(max(values) > min(values) for values in inside)
    for ball, values in zip(balls, inside, strict=True):
        assert 2 * float(ball.rad()) <= 4 * (max(values) - min(values)) + 2.0**-20


@pytest.mark.parametrize(("way", "ball_of"), [(PlainRays, lambda ball: ball), (LinkedRays, enclosure)])
@pytest.mark.parametrize("name", ["single-triangle", "parallel-projection"])
def test_a_rasteriser_rounds_no_camera_rays(name: str, way: Any, ball_of: Any) -> None:
    scene = open_scene(name)
    prepared = prepare(scene, FLOAT)
    exact = prepared.kernel.primary_ray(prepared.kernel.camera_frame(prepared.data), 20.5, 30.5)
    for rasterisation, widest in ((Rasterisation(8, 24, 22), 2.0**-44), (None, 2.0**-14)):
        rays = way(scene, ErrorModel("", 24, rasterisation=rasterisation))
        put_in_force(rays.prepared.arithmetic)
        balls = [ball_of(number) for vector in rays.primary_ray(20, 30) for number in vector]
        middles = [float(ball.mid()) for ball in balls]
        assert middles == pytest.approx(list(itertools.chain(*exact)), abs=widest)
        assert widest / 2.0**16 < max(float(ball.rad()) for ball in balls) < widest
