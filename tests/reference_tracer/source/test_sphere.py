from __future__ import annotations

from math import inf

import pytest

from raytruth.reference_tracer.source.sphere import distance_to_other_side, sphere_distance, sphere_normal

CENTER = (0.0, 0.0, 0.0)
AHEAD = (1.0, 0.0, 0.0)


@pytest.mark.clause("SPH-1", "SPH-3")
@pytest.mark.parametrize(
    ("origin", "distance"),
    [
        ((-3.0, 0.0, 0.0), 2.0),
        ((-3.0, 1.0, 0.0), 3.0),  # tangent: a hit
        ((-3.0, 1.0 + 2.0**-52, 0.0), inf),
        ((0.0, 0.0, 0.0), 1.0),
        ((0.5, 0.0, 0.0), 0.5),
        ((-0.5, 0.0, 0.0), 1.5),
        ((-1.0, 0.0, 0.0), 2.0),  # from the surface inward: the root 0 is not positive
        ((1.0, 0.0, 0.0), inf),  # from the surface outward
        ((0.0, 1.0, 0.0), inf),  # from the surface along it
        ((3.0, 0.0, 0.0), inf),
        ((3.0, 1.0, 0.0), inf),
    ],
)
def test_the_smallest_positive_root_is_found(origin: tuple[float, float, float], distance: float) -> None:
    assert sphere_distance(origin, AHEAD, CENTER, 1.0) == distance


@pytest.mark.clause("SPH-1")
def test_distances_are_in_units_of_the_directions_length() -> None:
    assert sphere_distance((-3.0, 0.0, 0.0), (0.25, 0.0, 0.0), CENTER, 1.0) == 8.0


@pytest.mark.clause("SPH-1")
def test_far_and_small_spheres_are_not_lost_to_cancellation() -> None:
    # The textbook's b² - 4ac cancels all digits here: 2^108 against 1.
    assert sphere_distance((-(2.0**54), 0.0, 0.0), AHEAD, CENTER, 1.0) == 2.0**54
    assert sphere_distance((-(2.0**54), 1.5, 0.0), AHEAD, CENTER, 1.0) == inf


@pytest.mark.clause("SPH-4")
def test_a_ray_that_starts_on_a_large_sphere_and_grazes_it_stays_near() -> None:
    # The origin is on the surface within rounding, and the ray nearly tangent: the true distance is below 0.02. The
    # quotient of constant and larger root was 2^21, more than the diameter.
    origin = tuple(map(float.fromhex, ("-0x1.1024830e3c1f9p+18", "-0x1.0d7c27c698895p+18", "-0x1.c129cbb3d3798p+19")))
    direction = tuple(map(float.fromhex, ("0x1.4eaa1edac12e6p-1", "0x1.4b65758d9e4b7p-1", "-0x1.9198f1d34e37bp-2")))
    for sign in (1.0, -1.0):
        turned = (sign * direction[0], sign * direction[1], sign * direction[2])
        distance = sphere_distance(origin, turned, CENTER, 1e6)  # type: ignore[arg-type] # three numbers
        assert distance < 0.02 or distance == inf


@pytest.mark.clause("SPH-4")
def test_the_other_side_is_the_other_end_of_the_chord() -> None:
    assert distance_to_other_side((-1.0, 0.0, 0.0), AHEAD, CENTER) == 2.0
    assert distance_to_other_side((-1.0, 0.0, 0.0), (2.0, 0.0, 0.0), CENTER) == 1.0
    assert distance_to_other_side((1.0, 0.0, 0.0), AHEAD, CENTER) == inf
    assert distance_to_other_side((0.0, 1.0, 0.0), AHEAD, CENTER) == inf


@pytest.mark.clause("SPH-5")
def test_the_normal_points_away_from_the_centre() -> None:
    assert sphere_normal((1.0, 2.0, 7.0), (1.0, 2.0, 3.0), 4.0) == (0.0, 0.0, 1.0)
    assert sphere_normal((1.0, 2.0, -1.0), (1.0, 2.0, 3.0), 4.0) == (0.0, 0.0, -1.0)
