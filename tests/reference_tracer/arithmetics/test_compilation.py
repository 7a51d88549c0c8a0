"""Compiled kernels give every bit that the interpreted source gives: on the whole library, and on drawn scenes."""

from __future__ import annotations

import ctypes
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT32, FLOAT64, Arithmetic, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.textbook_forms import VARIANTS
from raytruth.reference_tracer.rendering import first_hits, prepare, render_prepared
from raytruth.scenes.families.drawn import drawn
from raytruth.scenes.features import Feature
from raytruth.scenes.library import library_names
from tests.reference_tracer.small_scenes import library_scene

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-1", "ARI-12")


def single(name: str) -> Callable[[np.float32], np.float32]:
    """A function of the C library in float32: the one that compiled code calls, as NumPy's need not be."""
    function: Any = getattr(ctypes.CDLL(None), name)
    function.argtypes, function.restype = [ctypes.c_float], ctypes.c_float
    return lambda value: np.float32(function(value))


SINGLE_FUNCTIONS = {"sqrt": np.sqrt, "floor": np.floor, "tan": single("tanf"), "exp": single("expf")}
SINGLES = Arithmetic(
    "float32 with the C library",
    np.float32,
    {**SINGLE_FUNCTIONS, "inf": np.float32(math.inf), "pi": np.float32(math.pi)},
)


def assert_same_bits(scene: Scene, interpreted: Arithmetic, compiled: Arithmetic) -> None:
    of_python, of_machine = (prepare(scene, arithmetic) for arithmetic in (interpreted, compiled))
    with np.errstate(all="ignore"):
        images = [render_prepared(prepared).astype(np.float64) for prepared in (of_python, of_machine)]
        hits = [first_hits(prepared) for prepared in (of_python, of_machine)]
    assert images[0].tobytes() == images[1].tobytes()
    assert hits[0][0].astype(np.float64).tobytes() == hits[1][0].astype(np.float64).tobytes()
    assert hits[0][1].tobytes() == hits[1][1].tobytes()


@pytest.mark.parametrize("name", library_names())
def test_each_scene_of_the_library_has_the_same_bits_in_float64(name: str) -> None:
    assert_same_bits(library_scene(name, 8, 6), FLOAT, FLOAT64)


@pytest.mark.parametrize("name", library_names())
def test_each_scene_of_the_library_has_the_same_bits_in_float32(name: str) -> None:
    assert_same_bits(library_scene(name, 4, 3), SINGLES, FLOAT32)


@pytest.mark.parametrize("seed", range(8))
def test_scenes_drawn_at_random_have_the_same_bits(seed: int) -> None:
    scene = drawn(10.0 ** (seed - 4), seed).resized(8, 6)
    assert_same_bits(scene, FLOAT, FLOAT64)
    assert_same_bits(scene, SINGLES, FLOAT32)


@pytest.mark.parametrize("arithmetic", [FLOAT64, FLOAT32], ids=lambda arithmetic: arithmetic.name)
@pytest.mark.parametrize("name", VARIANTS)
def test_textbook_forms_compile_with_all_features(name: str, arithmetic: Arithmetic) -> None:
    kernel = make_kernel(arithmetic, set(Feature), Behaviour(VARIANTS[name]))
    assert {"render_rows", "first_hit_rows"} <= vars(kernel).keys()
