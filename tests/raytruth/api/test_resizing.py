from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth import resized
from raytruth.scenes.camera import LARGEST_SIDE
from raytruth.scenes.library import open_scene

pytestmark = pytest.mark.clause("SCN-1")

SCENE = open_scene("single-sphere")
SIDES = st.integers(1, LARGEST_SIDE)


@given(width=SIDES, height=SIDES)
def test_nothing_but_the_size_of_the_image_changes(width: int, height: int) -> None:
    other = resized(SCENE, width, height)
    assert (other.camera.width, other.camera.height) == (width, height)
    assert resized(other, SCENE.camera.width, SCENE.camera.height) == SCENE


@given(side=SIDES, wrong=st.one_of(st.integers(max_value=0), st.integers(LARGEST_SIDE + 1)))
def test_a_size_that_no_image_has_is_refused(side: int, wrong: int) -> None:
    for size in ((side, wrong), (wrong, side)):
        with pytest.raises(ValueError, match=r"^expected a width and a height from 1 to 8192 pixels, found .+\.$"):
            resized(SCENE, *size)
