from __future__ import annotations

from math import inf

import pytest

from reference_tracer.sphere import distance_to_other_side, sphere_distance, sphere_normal

CENTER = (0.0, 0.0, 0.0)
AHEAD = (1.0, 0.0, 0.0)


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


def test_distances_are_in_units_of_the_directions_length() -> None:
    assert sphere_distance((-3.0, 0.0, 0.0), (0.25, 0.0, 0.0), CENTER, 1.0) == 8.0


def test_far_and_small_spheres_are_not_lost_to_cancellation() -> None:
    # The textbook's b² - 4ac cancels all digits here: 2^108 against 1.
    assert sphere_distance((-(2.0**54), 0.0, 0.0), AHEAD, CENTER, 1.0) == 2.0**54
    assert sphere_distance((-(2.0**54), 1.5, 0.0), AHEAD, CENTER, 1.0) == inf


def test_the_other_side_is_the_other_end_of_the_chord() -> None:
    assert distance_to_other_side((-1.0, 0.0, 0.0), AHEAD, CENTER) == 2.0
    assert distance_to_other_side((-1.0, 0.0, 0.0), (2.0, 0.0, 0.0), CENTER) == 1.0
    assert distance_to_other_side((1.0, 0.0, 0.0), AHEAD, CENTER) == inf
    assert distance_to_other_side((0.0, 1.0, 0.0), AHEAD, CENTER) == inf


def test_the_normal_points_away_from_the_centre() -> None:
    assert sphere_normal((1.0, 2.0, 7.0), (1.0, 2.0, 3.0), 4.0) == (0.0, 0.0, 1.0)
    assert sphere_normal((1.0, 2.0, -1.0), (1.0, 2.0, 3.0), 4.0) == (0.0, 0.0, -1.0)
