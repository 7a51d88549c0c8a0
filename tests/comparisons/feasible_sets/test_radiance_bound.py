from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.radiance_bound import RadianceBound, radiance_bound
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.library import library_names
from tests.reference_tracer.small_scenes import library_scene, small_scene, sphere
from tests.scenes.exporter_scenes import BOARD, GLASS, LAMP, MIRROR, POINT, RED

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-6")

GREY = {"background": {"color": (0.25, 0.5, 0.125)}}


def scene(term: dict[str, Any], **changes: Any) -> Scene:
    """A sphere of the material, in front of a grey background."""
    base: dict[str, Any] = {"materials": {"m": term}, "objects": [sphere("m")], "max_depth": 3}
    return small_scene(**base | GREY | changes)


@pytest.mark.parametrize(
    ("of", "brightest"),
    [
        (scene(MIRROR), 0.5),
        (scene(MIRROR, background={"bottom": (0.1, 0.2, 0.7), "top": (0.3, 0.1, 0.0)}), 0.7),
        (scene(MIRROR, background={"color": (0.0, 0.0, 0.0)}), 0.0),
        (scene(LAMP), 4.0),
        (scene({"emission": {"radiance": BOARD}}), 2.0),
        (scene({"emission": {"radiance": (0.1, 0.1, 0.1)}}), 0.5),
        (scene(MIRROR, materials={"m": MIRROR, "unused": LAMP | RED}), 0.5),
        (scene(GLASS), 0.5),
    ],
)
def test_in_the_classical_convention_nothing_is_brighter_than_the_brightest_source(of: Scene, brightest: float) -> None:
    assert radiance_bound(of) == RadianceBound(brightest, brightest, 1.0)


@pytest.mark.parametrize(("inside", "at_camera"), [(None, 0.5), ("m", 0.5 * 1.5**2)])
def test_radiance_grows_with_the_square_of_the_index(inside: str | None, at_camera: float) -> None:
    bound = radiance_bound(scene(GLASS, convention="radiometric", camera={"inside": inside}))
    assert bound == RadianceBound(0.5 * 1.5**2, at_camera, 1.5**2)


def test_an_index_below_one_counts_from_the_other_side() -> None:
    bubble = {"dielectric": {"index_of_refraction": 0.5}}
    assert radiance_bound(scene(bubble, convention="radiometric")) == RadianceBound(0.5 * 4, 0.5 * 4, 4.0)


@pytest.mark.parametrize(
    "terms",
    [
        RED,
        {"specular": {"reflectance": (0.1, 0.1, 0.1), "exponent": 3.0, "model": "phong"}},
        {"ambient": {"reflectance": (0.1, 0.1, 0.1)}},
        {"mirror": {"reflectance": (0.5, 1.001, 0.5)}},
        {"dielectric": {"index_of_refraction": 1.5, "reflectance": (0.1,) * 3, "transmittance": (0.2,) * 3}},
        MIRROR | GLASS,
        MIRROR | LAMP,
        GLASS | LAMP,
    ],
)
def test_no_bound_is_known_of_what_is_lit_or_may_give_back_more_than_it_gets(terms: dict[str, Any]) -> None:
    assert radiance_bound(scene(terms, lights=[POINT])) is None


def test_a_mirror_that_shines_is_brighter_than_what_it_shows_and_what_it_sends_out() -> None:
    # Why such a surface has no bound: it gives back the sum.
    shining = {"mirror": {"reflectance": (1.0, 1.0, 1.0)}, "emission": {"radiance": (1.0, 1.0, 1.0)}}
    image = render(scene(shining, background={"color": (1.0, 1.0, 1.0)}), FLOAT)
    assert image.max() == 2.0


def test_no_pixel_of_the_library_is_brighter_than_its_bound() -> None:
    bounded = 0
    for name in library_names():
        of = library_scene(name, 8, 6)
        bound = radiance_bound(of)
        if bound is not None:
            bounded += 1
            image = np.asarray(render(of, FLOAT), dtype=np.float64)
            # A pixel is a sum of about ten products, each rounded a few times.
            assert image.max() <= bound.at_camera * (1 + 64 * 2.0**-53), name
            assert bound.at_camera <= bound.radiance
    assert bounded >= 10
