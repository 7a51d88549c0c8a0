from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from flint import arb, ctx

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.feasible_sets.feasible_pixel import MOST_OUTCOMES, PixelEvaluator, UndecidableError
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.comparisons.feasible_sets.rounded_rays import LinkedRays, PlainRays
from raytruth.comparisons.feasible_sets.tape_rays import TapeRays
from tests.reference_tracer.small_scenes import lamp, library_scene, small_scene, sphere

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-2")
WHITE = {"emission": {"radiance": (1.0, 1.0, 1.0)}}


@pytest.fixture(params=[PlainRays, LinkedRays, TapeRays], autouse=True)
def follow(request: pytest.FixtureRequest) -> Any:
    """All ways of following rays, one after the other."""
    return request.param


def evaluator(follow: Any, scene: Scene, bits: int = 24) -> PixelEvaluator:
    return PixelEvaluator(follow(scene, ErrorModel("", bits)), radiance_bound(scene), 24, 10**9)


def tangents(spheres: int, **changes: Any) -> Scene:
    """One ray along -z through the origin, and spheres of radius 1/2 that touch it, each behind the next."""
    objects = [sphere("white", (0.5, 0.0, 1.5 * k - 6.0), 0.5) for k in range(spheres)]
    base: dict[str, Any] = {"materials": {"white": WHITE}, "background": {"color": (0.0, 0.25, 0.0)}}
    return small_scene(**base | {"objects": objects} | changes)


def holds(box: Any, color: tuple[float, float, float]) -> bool:
    return all(ball.contains(arb(value)) for ball, value in zip(box, color, strict=True))


def test_a_pixel_that_nothing_is_in_doubt_of_has_one_outcome_as_wide_as_its_roundings(follow: Any) -> None:
    (box,), merged = evaluator(follow, small_scene(materials={"white": WHITE})).colors(0, 0)
    assert holds(box, (1, 1, 1))
    assert all(channel.rad() < 4 * 2.0**-24 for channel in box)  # times the weight, and added to black
    assert not merged


@pytest.mark.clause("NUM-3")
def test_a_tangent_ray_hits_and_misses(follow: Any) -> None:
    pixel = evaluator(follow, tangents(1))
    boxes = pixel.colors(0, 0, may_merge=False)[0]
    assert any(holds(box, (1, 1, 1)) for box in boxes)
    assert any(holds(box, (0, 0.25, 0)) for box in boxes)
    assert not any(holds(box, (0.5, 0.5, 0.5)) for box in boxes)
    hits = pixel.first_hits(0, 0)
    assert {hit.primitive for hit in hits} == {-1, 0}
    for hit in hits:
        expected = (11.0, 0.0, 0.0, -6.0, -1.0, 0.0, 0.0)  # distance, position, normal
        assert len(hit.values) == (7 if hit.primitive == 0 else 0)
        assert all(ball.overlaps(arb(value, 0.01)) for ball, value in zip(hit.values, expected, strict=False))


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"lights": [lamp((0.0, 0.0, 9.0))], "materials": {"white": {"diffuse": {"reflectance": (1.0, 1.0, 1.0)}}}},
    ],
)
def test_of_a_ray_with_too_many_outcomes_nothing_is_said(follow: Any, changes: dict[str, Any]) -> None:
    pixel = evaluator(follow, tangents(12, **changes))
    with pytest.raises(UndecidableError):
        pixel.colors(0, 0)
    with pytest.raises(UndecidableError):
        pixel.first_hits(0, 0)


def test_a_faint_ray_with_too_many_outcomes_brings_anything_up_to_its_weight(follow: Any) -> None:
    # A mirror in front of the camera shows the tangent spheres; it gives back an eighth.
    mirror = {"mirror": {"reflectance": (0.125, 0.125, 0.125)}}
    spheres = [sphere("white", (0.5, 0.0, 1.5 * k + 1.0), 0.5) for k in range(12)]
    # One triangle, since a renderer may miss both of two that share the edge which the ray meets.
    plate = {"shape": "triangle", "vertices": ((-9.0, -9.0, -1.0), (9.0, -9.0, -1.0), (0.0, 9.0, -1.0))}
    objects = [{**plate, "material": "mirror"}, *spheres]
    camera = {"position": (0.0, 0.0, 0.0), "look_at": (0.0, 0.0, -1.0)}
    scene = tangents(0, objects=objects, materials={"white": WHITE, "mirror": mirror}, camera=camera, max_depth=1)
    pixel = evaluator(follow, scene)
    (box,), merged = pixel.colors(0, 0)
    assert merged
    with pytest.raises(UndecidableError):
        pixel.colors(0, 0, may_merge=False)
    assert holds(box, (0.125, 0.125, 0.125))
    assert holds(box, (0.0, 0.25 * 0.125, 0.0))
    for channel in box:
        assert channel.upper() < 0.126
        assert channel.lower() > -0.001


@pytest.mark.parametrize(("reflectance", "is_traced"), [(2.0**-20, True), (2.0**-40, False)])
def test_a_weight_below_the_outputs_rounding_gets_no_tree_and_still_its_range(
    follow: Any, reflectance: float, *, is_traced: bool
) -> None:
    mirror = {"mirror": {"reflectance": (reflectance,) * 3}}
    scene = small_scene(materials={"white": mirror}, background={"color": (1.0, 0.5, 0.0)}, max_depth=1)
    (box,) = evaluator(follow, scene).colors(0, 0)[0]
    assert holds(box, (reflectance, reflectance / 2, 0.0))
    assert all(channel.upper() <= reflectance * (1 + 2.0**-10) for channel in box)
    assert (box[0].rad() < reflectance / 16) == is_traced


@pytest.mark.parametrize("name", ["glass-sphere", "total-reflection-prism", "whitted-1980", "bubble-in-glass"])
def test_no_pixel_has_more_outcomes_than_the_limit_and_every_one_is_finite(follow: Any, name: str) -> None:
    scene = library_scene(name, 8, 6)
    pixel = evaluator(follow, scene, 14)
    judged = 0
    for row in range(6):
        for column in range(8):
            try:
                boxes = pixel.colors(column, row)[0]
            except UndecidableError:
                continue
            judged += 1
            assert 1 <= len(boxes) <= MOST_OUTCOMES
            assert all(channel.is_finite() for box in boxes for channel in box)
    assert judged > 0


@pytest.mark.clause("CAM-5")
def test_the_camera_starts_in_its_medium(follow: Any) -> None:
    # Seen from inside glass of index 2, a world of radiance 1 outside has radiance 4 (n²) where nothing is reflected:
    # with R = (1/3)² at normal incidence, 4·(1-R) and then what is reflected inside, again and again.
    glass = {"dielectric": {"index_of_refraction": 2.0}}
    for depth, expected in [(1, 4 * 8 / 9), (2, 4 * 8 / 9 * (1 + 1 / 9)), (3, 4 * 8 / 9 * (1 + 1 / 9 + 1 / 81))]:
        scene = small_scene(
            convention="radiometric",
            materials={"white": glass},
            background={"color": (1.0, 1.0, 1.0)},
            camera={"position": (0.0, 0.0, 0.5), "look_at": (0.0, 0.0, 0.0), "inside": "white"},
            max_depth=depth,
        )
        (box,) = evaluator(follow, scene, 48).colors(0, 0)[0]
        assert abs(float(box[0].mid()) - expected) <= float(box[0].rad()) + 2.0**-50
        assert box[0].rad() < 2.0**-30  # plain balls lose 18 bits inside the sphere


@pytest.mark.clause("ARI-4")
def test_what_is_feasible_does_not_depend_on_the_precision_that_was_in_force_before(follow: Any) -> None:
    # Its numbers are untidy, so that few bits would show.
    scene = library_scene("sphere-over-floor", 5, 4)

    def ends() -> list[Any]:
        made = evaluator(follow, scene)
        boxes, hits = made.colors(2, 3)[0], made.first_hits(2, 3)
        balls = [ball for group in (*boxes, *(hit.values for hit in hits)) for ball in group]
        return [end for ball in balls for end in (ball.mid(), ball.rad())]

    with ctx.workprec(24):
        coarse = ends()
        assert ctx.prec == 24
    with ctx.workprec(500):
        fine = ends()
    assert coarse == fine
    assert len(fine) > 6
