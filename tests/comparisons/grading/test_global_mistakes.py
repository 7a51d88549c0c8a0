from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.grading.global_mistakes import (
    AS_IT_IS,
    GLOBAL_MISTAKES,
    GlobalMistake,
    output_of,
    rays_of,
    readings,
    rendered_scene,
    written_values,
)
from raytruth.comparisons.grading.reading import best_reading
from raytruth.comparisons.grading.scene_grading import expectations_of
from raytruth.comparisons.records.srgb import srgb_decoded, srgb_encoded
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from tests.comparisons.grading.small_scenes import ASSIGNMENT, AtOnce, picture, small_scene

pytestmark = pytest.mark.clause("GRD-3")

FLOATS = OutputModel("float32")
BYTES = OutputModel("uint8", "sRGB", clipped=True)
NAMES = [mistake.name for mistake in GLOBAL_MISTAKES]


def bytes_of(values: np.ndarray) -> np.ndarray:
    return np.floor(np.clip(values, 0.0, 1.0) * 255.0 + 0.5)


# How each mistake is made, written down without a look at how it is undone: from linear values to those that are read.
MADE = {
    "mirrored": lambda image: image[:, ::-1],
    "upside_down": lambda image: image[::-1],
    "channels_as_BGR": lambda image: image[..., [2, 1, 0]],
    "channels_as_GRB": lambda image: image[..., [1, 0, 2]],
    "channels_as_RBG": lambda image: image[..., [0, 2, 1]],
    "channels_as_GBR": lambda image: image[..., [1, 2, 0]],
    "channels_as_BRG": lambda image: image[..., [2, 0, 1]],
    "curve_in_a_linear_file": srgb_encoded,
    "curve_forgotten": lambda image: srgb_decoded(bytes_of(image) / 255.0),
    "curve_twice": lambda image: srgb_decoded(bytes_of(srgb_encoded(srgb_encoded(np.clip(image, 0, 1)))) / 255.0),
    "power_in_a_linear_file": lambda image: image ** (1 / 2.2),
    "eight_bits": lambda image: bytes_of(image) / 255.0,
    "codes_for_values": bytes_of,
    "times_255": lambda image: 255.0 * image,
}


def declared(mistake: GlobalMistake) -> OutputModel:
    """What a program declares that can make the mistake."""
    return FLOATS if mistake.output(FLOATS) is not None else BYTES


def made(mistake: GlobalMistake) -> np.ndarray:
    """What is read of a program with this mistake."""
    shown = rendered_scene((mistake,), small_scene())
    image = np.asarray(render(shown, FLOAT, rays_of((mistake,)).behaviour()), dtype=np.float64)
    wrong = MADE.get(mistake.name, lambda same: same)(image)
    return np.asarray(wrong, dtype=np.float32).astype(np.float64)


@pytest.mark.parametrize("name", NAMES)
def test_each_mistake_is_undone_so_that_every_pixel_is_right_and_without_that_most_are_wrong(name: str) -> None:
    mistake = GLOBAL_MISTAKES[NAMES.index(name)]
    expectations = expectations_of(small_scene(), ASSIGNMENT)
    image = made(mistake)
    assert not expectations.fit(image, declared(mistake), (mistake,)).wrong.any()
    assert expectations.fit(image, declared(mistake)).wrong.any()


@pytest.mark.parametrize("name", ["mirrored", "curve_in_a_linear_file", "half_a_pixel_top_left", "eight_bits"])
def test_the_reading_of_pictures_is_the_mistake_that_they_have(name: str) -> None:
    mistake = GLOBAL_MISTAKES[NAMES.index(name)]
    assert reading_of(made(mistake)) == (mistake,)


def test_two_mistakes_are_both_recognised_and_right_pictures_have_none() -> None:
    both = srgb_encoded(picture(small_scene()))[:, ::-1]
    assert {mistake.name for mistake in reading_of(both)} == {"mirrored", "curve_in_a_linear_file"}
    assert reading_of(picture(small_scene())) == AS_IT_IS


def test_a_wrong_pixel_stays_wrong_when_a_mistake_is_undone() -> None:
    image = picture(small_scene())
    image[2, 3] += 0.01
    fit = expectations_of(small_scene(), ASSIGNMENT).fit(image[:, ::-1], FLOATS, (GLOBAL_MISTAKES[0],))
    assert np.argwhere(fit.wrong).tolist() == [[2, 3]]


def reading_of(image: np.ndarray) -> tuple[GlobalMistake, ...]:
    scene = small_scene()
    images, scenes = {scene.name: np.ascontiguousarray(image)}, {scene.name: scene}
    return best_reading(images, scenes, ASSIGNMENT, {"all": [scene.name]}, FLOATS, AtOnce())


def test_readings_hold_no_two_mistakes_of_a_kind_and_none_that_the_format_cannot_have() -> None:
    for output in (FLOATS, BYTES, replace(FLOATS, clipped=True), OutputModel("rgbe")):
        for reading in readings(output):
            assert len({mistake.kind for mistake in reading}) == len(reading)
            assert output_of(reading, output) is not None
    assert {it.name for reading in readings(BYTES) for it in reading}.isdisjoint({"eight_bits", "times_255"})


def test_mistakes_travel_to_other_processes_by_their_names() -> None:
    assert pickle.loads(pickle.dumps(GLOBAL_MISTAKES)) == GLOBAL_MISTAKES


def test_what_is_done_to_radiance_never_falls() -> None:
    radiance = np.linspace(-0.5, 20.0, 1000)[:, np.newaxis]
    for mistake in GLOBAL_MISTAKES:
        assert (np.diff(written_values((mistake,), radiance), axis=0) >= 0).all()
