"""The parts of a scene's light, and the camera, as Cycles is given them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.renderers.cycles.translation import job_of
from tests.scenes.exporter_scenes import BALL, BOARD, FLOOR, GLASS, LAMP, MIRROR, POINT, RED, SUN, build

if TYPE_CHECKING:
    from raytruth.comparisons.renderers.cycles.job import Part

pytestmark = pytest.mark.clause("REN-2")

OBJECTS = [BALL, FLOOR | {"material": "mirror"}, FLOOR | {"material": "both"}]
MATERIALS = {"m": RED, "mirror": MIRROR, "both": RED | LAMP}


def kinds(part: Part) -> list[list[str]]:
    return [[closure.kind for closure in material] for material in part.materials]


def test_each_lamp_shines_alone_without_emission_and_what_shines_by_itself_without_diffuse_terms() -> None:
    scene = build(materials=MATERIALS, objects=OBJECTS, lights=[POINT, SUN], background={"color": (0.1, 0.2, 0.3)})
    *lit, shining = job_of(scene, 3, 0, 1).parts
    assert [[lamp.kind for lamp in part.lamps] for part in lit] == [["POINT"], ["SUN"]]
    for part in lit:
        assert kinds(part) == [["diffuse"], ["mirror"], ["diffuse"]]
        assert (part.bounces, part.background) == (3, None)
    assert kinds(shining) == [[], ["mirror"], ["emission"]]
    assert (shining.bounces, shining.lamps) == (2, ())
    assert shining.background == ((0.1, 0.2, 0.3), (0.1, 0.2, 0.3))


def test_without_bounces_mirrors_and_glass_are_black_for_what_shines_by_itself() -> None:
    scene = build(materials={"m": GLASS, "mirror": MIRROR | LAMP}, objects=OBJECTS[:2])
    (part,) = job_of(scene, 0, 0, 1).parts
    assert kinds(part) == [[], ["emission"]]
    assert part.bounces == 0
    (dark,) = job_of(build(), 0, 0, 1).parts
    assert (kinds(dark), dark.lamps) == ([[]], ())


def test_lamps_textures_and_indices_are_the_scenes() -> None:
    around = {"dielectric": {"index_of_refraction": 1.25}}
    inner = {"dielectric": {"index_of_refraction": 1.5, "outside": "around"}}
    scene = build(
        convention="whitted",
        materials={"m": {"emission": {"radiance": BOARD}}, "glass": inner, "around": around},
        objects=[BALL, FLOOR | {"material": "glass"}],
    )
    (part,) = job_of(scene, 1, 0, 1).parts
    (board,), (glass,) = part.materials
    assert glass.index == pytest.approx(1.2)
    assert (board.color.even, board.color.odd) == ((2.0, 0.1, 0.1), (0.1, 0.1, 0.2))
    assert (board.color.size, board.color.offset, board.color.axes) == (0.7, (0.2, 0.1), (0, 2))
    (lit,) = job_of(build(lights=[POINT]), 0, 0, 1).parts
    assert (lit.lamps[0].vector, lit.lamps[0].strength) == ((1.0, 2.0, 3.0), (9.0, 8.0, 7.0))


def test_a_camera_has_right_handed_axes_and_sees_all_objects() -> None:
    camera = job_of(build(objects=[BALL, FLOOR]), 0, 0, 1).camera
    right, up, backward = (np.array(axis) for axis in camera.axes)
    assert np.allclose(np.cross(right, up), backward)
    assert np.allclose(backward, np.array([0.0, 1.0, 5.0]) / np.sqrt(26))
    assert camera.tangent == pytest.approx(np.tan(np.radians(20)))
    farthest = max(np.linalg.norm(np.subtract(vertex, camera.position)) for vertex in FLOOR["vertices"])
    assert camera.far > 1.5 * farthest
