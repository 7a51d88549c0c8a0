"""Renderers with every kind of output, simulated: they pass by their own output model, and fail by a wrong one."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.feasible_sets.feasible_set import feasible_set
from raytruth.comparisons.judgement.exact_test import judge_image
from raytruth.comparisons.judgement.pixel_verdict import verdict_of
from raytruth.comparisons.records.results import Verdict
from raytruth.comparisons.renderers.own_tracer import ReferenceTracer
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.lights import PointLight
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet
    from raytruth.scenes.scene import Scene

    Array = NDArray[np.float64]

pytestmark = pytest.mark.clause("VER-5")

BYTES = OutputModel("uint8", "sRGB", clipped=True)
LINEAR_BYTES = OutputModel("uint8", clipped=True)
WORDS = OutputModel("uint16", clipped=True)
CLIPPED_HALVES = OutputModel("float16", clipped=True)
HALVES = OutputModel("float16")


@cache
def scene() -> Scene:
    """A sphere, lit so brightly that a part of it is beyond 1."""
    dim = library_scene("single-sphere", 24, 24)
    brightest = float(np.asarray(render(dim, FLOAT), dtype=np.float64).max())
    lights = []
    for light in dim.lights:
        assert isinstance(light, PointLight)
        intensity = tuple(1.7 / brightest * channel for channel in light.intensity)
        lights.append(light.model_copy(update={"intensity": intensity}))
    return dim.model_copy(update={"lights": tuple(lights)})


@cache
def reference() -> Array:
    return np.asarray(render(scene(), FLOAT), dtype=np.float64)


@cache
def feasible(output: OutputModel) -> FeasibleSet:
    return feasible_set(scene(), replace(ReferenceTracer.error_model, output=output))


def encoded(linear: Array) -> Array:
    """The curve of sRGB, written once more."""
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)


def decoded(values: Array) -> Array:
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def as_codes(values: Array, largest: int) -> Array:
    return np.floor(np.clip(values, 0, 1) * largest + 0.5)


def as_halves(values: Array) -> Array:
    return values.astype(np.float16).astype(np.float64)


def verdict(image: Array, output: OutputModel) -> Verdict:
    judgement, _ = judge_image(image.astype(np.float32), reference(), feasible(output))
    assert judgement.unjudged == 0
    return verdict_of(judgement)[0]


def test_a_right_renderer_passes_with_every_output() -> None:
    linear = reference()
    assert linear.max() > 1.5
    clipped = np.clip(linear, 0, 1)
    assert verdict(decoded(as_codes(encoded(clipped), 255) / 255), BYTES) == Verdict.PASS
    assert verdict(as_codes(clipped, 65535) / 65535, WORDS) == Verdict.PASS
    assert verdict(as_halves(clipped), CLIPPED_HALVES) == Verdict.PASS
    assert verdict(as_halves(linear), HALVES) == Verdict.PASS
    truncated = np.floor(clipped * 255) / 255
    assert verdict(truncated, OutputModel("uint8", "linear", "truncation", clipped=True)) == Verdict.PASS
    by_way_of_float32 = as_codes(encoded(clipped.astype(np.float32)), 255)
    assert verdict(decoded(by_way_of_float32 / 255), BYTES) == Verdict.PASS


def off_by_one_code(codes: Array, largest: int) -> Array:
    return np.where(codes < largest, codes + 1, codes - 1)


def wrong_images() -> dict[str, tuple[Array, OutputModel]]:
    """Images of renderers that do something else than they declare, and what they declare."""
    linear = reference()
    clipped = np.clip(linear, 0, 1)
    srgb, words = as_codes(encoded(clipped), 255), as_codes(clipped, 65535)
    return {
        "linear codes read as sRGB": (decoded(as_codes(clipped, 255) / 255), BYTES),
        "sRGB codes read as linear": (srgb / 255, LINEAR_BYTES),
        "encoded twice": (decoded(as_codes(encoded(encoded(clipped)), 255) / 255), BYTES),
        "scaled by 254 in place of 255": (decoded(as_codes(encoded(clipped), 254) / 255), BYTES),
        "scaled by 256 and truncated": (np.clip(np.floor(clipped * 256), 0, 255) / 255, LINEAR_BYTES),
        "one code off everywhere, 8 bits": (decoded(off_by_one_code(srgb, 255) / 255), BYTES),
        "one code off everywhere, 16 bits": (off_by_one_code(words, 65535) / 65535, WORDS),
        "8 bits stretched to 16": (as_codes(clipped, 255) / 255, WORDS),
        "truncated, declared as rounded": (np.floor(clipped * 65535) / 65535, WORDS),
        "not clipped": (as_halves(linear), CLIPPED_HALVES),
        "clipped": (as_halves(clipped), HALVES),
        "one half off everywhere": (np.nextafter(linear.astype(np.float16), np.float16(9)).astype(np.float64), HALVES),
        "codes that wrap around": (as_codes(np.where(linear > 1, linear - 1, linear), 65535) / 65535, WORDS),
    }


def test_a_renderer_that_writes_something_else_than_it_declares_fails() -> None:
    verdicts = {name: verdict(image, declared) for name, (image, declared) in wrong_images().items()}
    assert verdicts == dict.fromkeys(verdicts, Verdict.FAIL)
