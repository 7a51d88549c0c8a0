import numpy as np
import pytest

from raytruth.comparisons.noise.lobes import find_lobes
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import open_scene
from tests.comparisons.noise.lobe_images import truth_of
from tests.meta.lobe_biases import GLASS_SCENES, bound_of, lobes_of

pytestmark = pytest.mark.clause("VER-6")


@pytest.mark.parametrize("name", GLASS_SCENES)
def test_the_expectation_over_the_paths_is_the_truth(name):
    lobes = lobes_of(name)
    # The compiled tracer sums some 20 paths of radiances below 1 in another order, and may fuse operations.
    np.testing.assert_allclose(truth_of(lobes), render(open_scene(name)), rtol=0, atol=2.0**-40)


@pytest.mark.parametrize("name", GLASS_SCENES)
def test_the_paths_of_a_pixel_are_a_distribution_within_the_bound(name):
    lobes = lobes_of(name)
    totals = np.bincount(lobes.pixel, lobes.probability)
    np.testing.assert_allclose(totals, np.ones(lobes.shape[0] * lobes.shape[1]), rtol=0, atol=2.0**-45)
    assert np.all(lobes.probability > 0)
    assert np.all(np.diff(lobes.pixel) >= 0)
    assert lobes.value.min() >= 0
    assert lobes.value.max() <= bound_of(name)
    # Probabilities sum to 1 whatever R is: the mean of the score is 0.
    np.testing.assert_allclose(lobes.expectation(lobes.split_score), 0.0, atol=2.0**-40)


def glass_pane(index):
    """Seen straight on: r = ((n−1)/(n+1))² at both surfaces, a lamp behind, darkness in front."""
    corners = [[-9.0, -9.0], [9.0, -9.0], [0.0, 12.0]]
    back, front = ([[*corner, z] for corner in corners] for z in (-1.0, 0.0))
    scene = open_scene("glass-slab").model_dump()
    scene |= {
        "max_depth": 3,
        "background": {"color": (0.0, 0.0, 0.0)},
        "camera": {
            "projection": "orthographic",
            "position": (0.0, 0.0, 4.0),
            "look_at": (0.0, 0.0, 0.0),
            "width": 1,
            "height": 1,
            "view_height": 0.1,
        },
        "materials": {
            "glass": {"dielectric": {"index_of_refraction": index}},
            "lamp": {"emission": {"radiance": (1.0, 0.5, 0.25)}},
        },
        "objects": [
            {"shape": "triangle", "vertices": front, "material": "glass"},
            {"shape": "triangle", "vertices": back[::-1], "material": "glass"},
            {"shape": "sphere", "center": (0.0, 0.0, -8.0), "radius": 2.0, "material": "lamp"},
        ],
    }
    return type(open_scene("glass-slab")).model_validate(scene)


def test_a_pane_of_glass_has_the_paths_of_the_textbook():
    index = 1.5
    r = ((index - 1) / (index + 1)) ** 2
    lobes = find_lobes(glass_pane(index))
    t = 1 - r
    expected = {  # reflections, transmissions: probability, red, score
        (1, 0): (r, 0.0, 1.0),
        (0, 2): (t * t, 1.0, -2 * r / t),
        (1, 2): (t * r * t, 0.0, 1 - 2 * r / t),  # back to the camera's side
        (2, 1): (t * r * r, 0.0, 2 - r / t),  # the third surface is the last: nothing follows
    }
    found = {
        (int(a), int(b)): (p, v[0], s)
        for a, b, p, v, s in zip(
            lobes.reflections, lobes.transmissions, lobes.probability, lobes.value, lobes.split_score, strict=True
        )
    }
    assert found.keys() == expected.keys()
    for key, values in expected.items():
        np.testing.assert_allclose(found[key], values, atol=2.0**-45)
    assert not lobes.mirrors.any()
    assert not lobes.sees_directly().any()


def test_glass_that_nothing_shows_draws_one_lobe_alone():
    lobes = find_lobes(glass_pane(1.0))
    assert lobes.probability.tolist() == [1.0]
    assert lobes.value.tolist() == [[1.0, 0.5, 0.25]]
    assert lobes.split_score.tolist() == [0.0]


def test_pixels_that_see_neither_mirror_nor_glass_are_told_from_the_others():
    lobes = lobes_of("glass-and-mirror")
    surfaces = np.bincount(lobes.pixel, lobes.mirrors + lobes.reflections + lobes.transmissions).reshape(lobes.shape)
    direct = lobes.sees_directly()
    np.testing.assert_array_equal(direct, surfaces == 0)
    assert direct.any()
    only_mirrors = (np.bincount(lobes.pixel, lobes.reflections + lobes.transmissions) == 0).reshape(lobes.shape)
    assert (only_mirrors & ~direct).any()
