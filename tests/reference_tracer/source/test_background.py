from __future__ import annotations

from typing import Any

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import prepare
from tests.reference_tracer.small_scenes import small_scene

pytestmark = pytest.mark.clause("BG-1")


def seen(background: dict[str, Any] | None, direction: tuple[float, float, float]) -> tuple[float, float, float]:
    prepared = prepare(small_scene(background=background) if background else small_scene(), FLOAT)
    color: tuple[float, float, float] = prepared.kernel.background_radiance(prepared.data, direction)
    return color


BOTTOM, TOP = (1.0, 2.0, 3.0), (5.0, 4.0, 3.0)


@pytest.mark.parametrize(
    ("height", "color"), [(-1.0, BOTTOM), (1.0, TOP), (0.0, (3.0, 3.0, 3.0)), (0.5, (4.0, 3.5, 3.0))]
)
def test_a_gradient_is_linear_in_the_height_of_the_direction(height: float, color: tuple[float, float, float]) -> None:
    assert seen({"bottom": BOTTOM, "top": TOP}, (0.0, height, 0.0)) == color


def test_a_constant_is_seen_in_every_direction() -> None:
    assert seen({"color": TOP}, (0.0, 1.0, 0.0)) == seen({"color": TOP}, (0.0, -1.0, 0.0)) == TOP


def test_nothing_stated_is_black() -> None:
    assert seen(None, (0.0, 1.0, 0.0)) == (0.0, 0.0, 0.0)
