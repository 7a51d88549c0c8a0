from __future__ import annotations

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT64
from raytruth.reference_tracer.rendering import (
    ROWS_IN_A_BAND,
    first_hits,
    prepare,
    primary_rays,
    render,
    render_prepared,
)
from tests.reference_tracer.small_scenes import library_scene


@pytest.mark.clause("ARI-8")
def test_images_in_bands_of_rows_are_those_of_one_pass() -> None:
    scene = library_scene("phong-sphere", 5, 3 * ROWS_IN_A_BAND + 1)  # the last band is short
    assert render(scene, FLOAT64).tolist() == render(scene, FLOAT).tolist()


@pytest.mark.clause("IMG-2")
def test_more_samples_give_another_picture_of_the_same_shape_and_type() -> None:
    prepared = prepare(library_scene("phong-sphere", 8, 6))
    one, four = render_prepared(prepared), render_prepared(prepared, samples=2)
    assert one.shape == four.shape == (6, 8, 3)
    assert one.dtype == four.dtype == np.float64
    assert (one != four).any()


@pytest.mark.clause("IMG-4")
def test_primary_rays_meet_at_the_depths_what_first_hits_names() -> None:
    scene = library_scene("single-sphere", 12, 9)
    prepared = prepare(scene, FLOAT)
    origins, directions = primary_rays(scene)
    depths, primitives = first_hits(prepared)
    assert set(np.unique(primitives)) == {-1, 0}
    for place in np.ndindex(depths.shape):
        ray = tuple(origins[place].tolist()), tuple(directions[place].tolist())
        assert prepared.kernel.nearest_hit(prepared.data, *ray, -1) == (depths[place], primitives[place])
