"""What programs have by convention is undone, and nothing is lost by that."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.comparisons.error_models.handed_cameras import FieldOfView, handed_camera
from raytruth.comparisons.renderers.program.conventions import CORNERS, Conventions
from raytruth.reference_tracer.camera_rays import CENTRES
from tests.reference_tracer.small_scenes import lamp, small_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("VER-17")

ORDERS = st.fixed_dictionaries(
    {"flip_x": st.booleans(), "flip_y": st.booleans(), "handedness": st.sampled_from(["right", "left"])}
)
SIZES = st.integers(2, 9)


def as_written(image: NDArray[Any], flip_x: bool, flip_y: bool, handedness: str) -> NDArray[Any]:
    """What a program with these conventions makes of a right image, pixel by pixel."""
    height, width = image.shape[:2]
    written = np.empty_like(image)
    for row in range(height):
        for column in range(width):
            x = width - 1 - column if handedness == "left" else column
            x = width - 1 - x if flip_x else x
            written[row, column] = image[height - 1 - row if flip_y else row, x]
    return written


@given(ORDERS, SIZES, SIZES, st.integers(0, 2**32 - 1))
def test_the_order_of_pixels_is_undone_bit_for_bit(order: dict[str, Any], width: int, height: int, seed: int) -> None:
    bits = np.random.default_rng(seed).integers(0, 2**32, (height, width, 3), dtype=np.uint32)
    image = bits.view(np.float32)  # every bit pattern, NaN among them
    undone = Conventions(**order).undone(as_written(image, **order))
    np.testing.assert_array_equal(np.ascontiguousarray(undone).view(np.uint32), bits)


@given(ORDERS, st.sampled_from(sorted(CORNERS)), st.booleans(), SIZES, SIZES, st.data())
def test_the_rays_are_those_of_the_pixels_as_they_lie_in_the_file(
    order: dict[str, Any], pixel: str, less_one: bool, width: int, height: int, data: st.DataObject
) -> None:
    conventions = Conventions(**order, pixel=pixel, pitch="size less one" if less_one else "size")
    rays = conventions.camera_rays()
    sides = ((width, 0, rays.x, conventions.mirrored), (height, 1, rays.y, conventions.flip_y))
    for side, axis, within, is_flipped in sides:
        place = data.draw(st.integers(0, side - 1))
        pitch = Fraction(side, side - 1) if less_one else Fraction(1)
        # The program's own formula, in its own picture; in the scene's it lies as far from the other edge if flipped.
        point = (place + Fraction(CORNERS[pixel][axis])) * pitch
        expected = side - point if is_flipped else point
        place_in_scene = side - 1 - place if is_flipped else place
        assert (place_in_scene + Fraction(within)) * pitch == expected
    assert rays.edge_to_edge == less_one


def test_two_mirrors_are_none_and_centres_are_centres_in_any_order() -> None:
    assert not Conventions(flip_x=True, handedness="left").mirrored
    for flip in (False, True):
        assert Conventions(flip_x=flip, flip_y=flip).camera_rays() == CENTRES


@pytest.mark.parametrize("field_of_view", get_args(FieldOfView))
def test_the_program_is_told_its_own_angle_and_depth(field_of_view: FieldOfView) -> None:
    scene = small_scene(projection="perspective", width=6, height=4, extent=40.0, max_depth=3)
    handed = Conventions(field_of_view=field_of_view, depth=1).handed(scene)
    assert handed.camera == handed_camera(field_of_view, scene.camera)
    assert handed.max_depth == 4
    assert Conventions().handed(scene) == scene


def test_what_cannot_be_undone_is_refused_with_its_reason() -> None:
    flat = small_scene(width=1, height=4, lights=[lamp((1.0, 2.0, 3.0))], max_depth=1)
    assert "no size less one" in str(Conventions(pitch="size less one").refuses(flat, 0))
    assert "would be -1 by the program's counting" in str(Conventions(depth=-2).refuses(flat, 0))
    assert Conventions(depth=-1, pixel="top left").refuses(flat, 0) is None


@pytest.mark.parametrize(("brightness", "samples", "refused"), [(0.9, 4, False), (1.1, 4, True), (1.1, 0, False)])
def test_samples_that_are_clamped_are_judged_where_none_is_above_1(
    brightness: float, samples: int, refused: bool
) -> None:
    emission = {"white": {"emission": {"radiance": (brightness, 0.5, 0.5)}}}
    scene = small_scene(materials=emission)
    assert (Conventions(clamped_samples=True).refuses(scene, samples) is not None) == refused
    lit = small_scene(lights=[lamp((1.0, 2.0, 3.0))])
    assert (Conventions(clamped_samples=True).refuses(lit, samples) is not None) == (samples > 0)
