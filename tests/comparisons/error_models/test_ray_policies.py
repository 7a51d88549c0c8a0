"""Policies of people's tracers: who has what it declares passes, and who has ten times that fails where it shows."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from flint import arb

from raytruth.comparisons.error_models.behaviours import behaviour_of
from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.error_models.shortcuts import has_shortcuts, shortcuts_in_words, without_shortcuts
from raytruth.comparisons.error_models.start_bounds import largest_terms
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import distances_in_tolerances
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.arithmetics.balls import Decisions, rounded_ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.rendering import prepare, render_prepared
from raytruth.scenes.features import Feature
from raytruth.scenes.scene import Scene
from tests.comparisons.error_models.low_scenes import at, low_things, program
from tests.reference_tracer.kernels import kept_precision, put_in_force

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from raytruth.reference_tracer.source.numbers import Vector

pytestmark = [pytest.mark.usefixtures("keep_precision"), pytest.mark.clause("VER-2")]

BITS = 39
"""Of float64, as declared by who does not know better."""


@pytest.fixture
def keep_precision() -> Iterator[None]:
    yield from kept_precision()


def wrong_pixels(image: Any, scene: Scene, model: ErrorModel) -> int:
    return int((distances_in_tolerances(image, feasible_set(scene, model)) > 1).sum())


H = 2.0**-12
TESTED = {"excludes_surface": False}
POLICIES: dict[str, Callable[[float], RayOffset]] = {
    "along the normal": lambda length: RayOffset(absolute=length, **TESTED),
    "along the normal, excluded": lambda length: RayOffset(absolute=length),
    "along the ray": lambda length: RayOffset(absolute=2 * length, along="direction", **TESTED),
    "along the ray, excluded": lambda length: RayOffset(absolute=2 * length, along="direction"),
    "least distance": lambda length: RayOffset(minimum_distance=2 * length, **TESTED),
    "least distance, excluded": lambda length: RayOffset(minimum_distance=2 * length),
    "relative to the point": lambda length: RayOffset(relative=length / 8),
    "relative to the scene": lambda length: RayOffset(relative=length / 8.4, scale="scene"),
    "least distance relative to the point": lambda length: RayOffset(relative_minimum_distance=length / 4, **TESTED),
    "least distance relative to the scene": lambda length: RayOffset(
        relative_minimum_distance=length / 4.2, scale="scene", **TESTED
    ),
    # Of the floor the terms are its height, 2; a program that has the bound itself may use half of it.
    "by a bound of the error": lambda length: RayOffset(error_bound=length * 2.0**BITS),
}
KINDS = ("shadow", "reflected", "refracted")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("policy", POLICIES)
def test_who_has_what_it_declares_passes_and_who_has_ten_times_that_does_not(policy: str, kind: str) -> None:
    def of_one_kind(offset: RayOffset) -> ErrorModel:
        return ErrorModel("", BITS, **{f"{kind}_offset": offset})  # type: ignore[arg-type]  # the key of a field

    scene = low_things(kind, H)
    declared = of_one_kind(POLICIES[policy](H))
    image = program(scene, declared)
    assert wrong_pixels(image, scene, declared) == 0
    assert wrong_pixels(image, scene, replace(declared, **{f"{kind}_offset": POLICIES[policy](H / 10)})) > 0
    others = {f"{other}_offset": POLICIES[policy](H) for other in KINDS if other != kind}
    assert wrong_pixels(image, scene, ErrorModel("", BITS, **others)) > 0  # type: ignore[arg-type]  # as above


def by_units_of_float32(primitive: int, point: Vector, normal: Vector, direction: Vector) -> tuple[Vector, int]:  # noqa: ARG001 - the signature of the function it stands for
    """Wächter and Binder 2019, listing 1; `moved` does it with the bits."""
    x, y = moved(point[0], normal[0]), moved(point[1], normal[1])  # noqa: F821 - a constant of the behaviour
    return (x, y, moved(point[2], normal[2])), primitive  # noqa: F821 - as above


def moved_by(units: int) -> Callable[[float, float], float]:
    def moved(coordinate: float, part: float) -> float:
        number = np.float32(coordinate)
        steps = int(units * part)
        bits = np.array(number.view(np.int32) + np.int32(-steps if number < 0 else steps), dtype=np.int32)
        near_zero = abs(coordinate) < 1 / 32
        return float(np.float32(coordinate + part * units / 256 / 65536)) if near_zero else float(bits.view(np.float32))

    return moved


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "policy", ["along the normal", "along the normal, excluded", "along the ray", "least distance, excluded"]
)
def test_who_leaves_an_infinite_plane_as_it_declares_passes(policy: str, kind: str) -> None:
    scene = low_things(kind, H, infinite=True)

    def of_one_kind(offset: RayOffset) -> ErrorModel:
        return ErrorModel("", BITS, **{f"{kind}_offset": offset})  # type: ignore[arg-type]  # the key of a field

    declared, sloppy = (of_one_kind(POLICIES[policy](length)) for length in (H / 16, H * 10 / 16))
    assert wrong_pixels(program(scene, declared), scene, declared) == 0
    assert wrong_pixels(program(scene, sloppy), scene, declared) > 0


@pytest.mark.parametrize(("units", "fails"), [(256, False), (2560, True)])
def test_who_moves_coordinates_by_units_in_the_last_place_passes(units: int, fails: bool) -> None:
    """256 units of a float32 of 2 are 2^-14, which passes under a wall of 2^-12; ten times as many over it."""
    scene = low_things("shadow", H)
    moving = Behaviour({"departure": by_units_of_float32}, constants={"moved": moved_by(units)})
    image = render_prepared(prepare(scene, FLOAT, moving)).astype(float)
    assert (wrong_pixels(image, scene, ErrorModel("", BITS, RayOffset(in_units=True))) > 0) == fails
    lower = low_things("shadow", 2.0**-15)
    beyond = render_prepared(prepare(lower, FLOAT, moving)).astype(float)
    assert wrong_pixels(beyond, lower, ErrorModel("", BITS, RayOffset(in_units=True))) == 0
    assert wrong_pixels(beyond, lower, ErrorModel("", BITS)) > 0


def test_the_starts_that_are_moved_by_units_lie_in_their_balls() -> None:
    model = ErrorModel("", 24, RayOffset(in_units=True))
    arithmetic = put_in_force(rounded_ball_arithmetic(24, Decisions()))
    kernel: Any = make_kernel(arithmetic, set(Feature), behaviour_of(model, low_things("shadow", H)))
    random, moved = np.random.default_rng(4), moved_by(256)
    for _ in range(500):
        point = (random.normal(size=3) * 10.0 ** random.uniform(-6, 6)).astype(np.float32).astype(float)
        normal = random.normal(size=3)
        normal = (normal / np.linalg.norm(normal)).astype(np.float32).astype(float)
        balls = [tuple(map(arb, vector.tolist())) for vector in (point, normal)]
        start = kernel.start_of(0, 0, *balls, balls[1])
        for ball, coordinate, part in zip(start, point, normal, strict=True):
            assert ball.contains(arb(moved(coordinate, part)))


def test_the_terms_of_a_point_are_the_largest_along_the_normal() -> None:
    scene = low_things("refracted", H)
    floor, *plate = largest_terms(scene)
    assert floor == pytest.approx(2.0)
    assert plate == pytest.approx([2.0 - H / 2] * 2)


def test_formulas_are_arithmetic_and_offsets_shortcuts() -> None:
    formulas = {"sphere_test": "quadratic", "triangle_test": "cramer", "fresnel": "cosines", "refraction": "bec"}
    plain = ErrorModel("", 24, directions="normalised", smallest=1e-38, **formulas)  # type: ignore[arg-type]  # fields
    assert not has_shortcuts(plain)
    assert without_shortcuts(plain) == plain
    for shortcut in (
        {"shadow_offset": RayOffset(absolute=1e-3)},
        {"reflected_offset": RayOffset(relative_minimum_distance=1e-3)},
        {"refracted_offset": RayOffset(in_units=True)},
        {"ray_offset": RayOffset(error_bound=8)},
        {"shadow_aim": "either"},
    ):
        declared = replace(plain, **shortcut)  # type: ignore[arg-type]  # as above
        assert has_shortcuts(declared)
        assert without_shortcuts(declared) == plain


def test_the_shortcuts_of_all_kinds_are_told_by_their_longest() -> None:
    scene = low_things("shadow", H)
    model = ErrorModel(
        "", 24, shadow_offset=RayOffset(relative=1e-3), reflected_offset=RayOffset(relative_minimum_distance=2e-3)
    )
    words = shortcuts_in_words(model, scene)
    assert words.startswith("its ray offset is up to 0.0084,")
    assert "its least distance is up to 0.017," in words


@pytest.mark.parametrize("aim", ["light", "parallel", "either"])
def test_a_shadow_ray_that_starts_beside_the_surface_may_go_parallel(aim: Any) -> None:
    """A plate a little before a near lamp hides it from who aims at it, and not from who passes beside it."""
    scene = low_things("shadow", H)
    offset = RayOffset(absolute=H)
    plate = [at(-1.2 + x * H / 2, 3 - H, z * H / 2) for x, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    described = scene.model_dump(mode="json")
    described["objects"][1]["vertices"] = plate
    described["lights"] = [{"kind": "point", "position": at(-1.2, 3, 0), "intensity": [9] * 3, "falloff": "none"}]
    described["camera"] |= {"position": at(0, 1, 0), "view_height": 0.1}
    hidden = Scene.model_validate(described)
    image = program(hidden, ErrorModel("", BITS, offset, shadow_aim="parallel"))
    assert (wrong_pixels(image, hidden, ErrorModel("", BITS, offset, shadow_aim=aim)) == 0) == (aim != "light")


def test_what_is_flushed_to_zero_is_feasible_if_it_is_declared() -> None:
    described = low_things("shadow", H).model_dump(mode="json")
    described["materials"]["floor"] = {"emission": {"radiance": [1e-30, 1, 1]}}
    dim = Scene.model_validate(described)
    image = program(dim, ErrorModel("", BITS))
    image[..., 0] = 0.0
    assert wrong_pixels(image, dim, ErrorModel("", BITS)) == 12
    assert wrong_pixels(image, dim, ErrorModel("", BITS, smallest=2e-30)) == 0
    assert wrong_pixels(image, dim, ErrorModel("", BITS, smallest=1e-31)) == 12
